"""``colift validity`` as a user meets it."""

import json
import math

import pytest
from colift.cli.tables.validity import source_heading
from colift.cli.validity import separated
from colift.leaderboard.practice.season_import import PlayedSeason

pytestmark = pytest.mark.slow

FEW = ("--policies", "copy,hold,reactive,proportional,gain=0.4", "--suite", "quick-v1")


def write(path, shape, trials=4):
    """Write lifts of two seconds, each with a later peak than the one before."""
    rows = [
        f"{trial},{k / 30:.4f},{0.3 * shape((k / 60) ** (1 + 0.1 * trial)):.5f}\n"
        for trial in range(trials)
        for k in range(61)
    ]
    path.write_text("trial,t_s,z_m\n" + "".join(rows))
    return path


@pytest.fixture
def files(tmp_path):
    """Two sources: people who lift smoothly, and people who go up and down at once."""
    return (
        write(tmp_path / "smooth.csv", lambda u: u**3 * (10 - 15 * u + 6 * u * u)),
        write(tmp_path / "hasty.csv", lambda u: math.sin(math.pi * u) ** 2, trials=3),
    )


def test_each_source_has_a_table_and_each_suite_a_verdict_there(colift, files):
    done = colift("validity", *files, *FEW, COLUMNS="100")
    assert (done.returncode, done.stderr) == (0, "")
    for wanted in (
        "smooth: 4 lifts, two people ",
        "hasty: 3 lifts, two people ",
        "quick-v1 ",
        "Spearman",
        "Kendall",
        "ratios off by",
        "two people, mm",
        "proportional,gain=0.4",
        "95 % intervals, for other people",
        "for other lifts of the same people",
    ):
        assert wanted in done.stdout
    verdicts = [line for line in done.stdout.splitlines() if line.startswith("quick-v1 ")]
    assert [" on smooth:" in line or " on hasty:" in line for line in verdicts] == [True, True]
    assert not any(line.endswith(" ") for line in done.stdout.splitlines())


def test_json_has_correlations_with_intervals_by_source_and_suite(colift, files):
    done = colift("validity", *files, *FEW, "--json")
    content = json.loads(done.stdout)
    assert [source["name"] for source in content["sources"]] == ["smooth", "hasty"]
    for source in content["sources"]:
        (suite,) = source["suites"]
        assert suite["name"] == "quick-v1"
        ratio = suite["ratio"]
        for found in (suite["spearman"], suite["kendall"], ratio["factor"], ratio["bias"]):
            assert found["low"] <= found["value"] <= found["high"]
        assert -1.0 <= suite["kendall"]["low"] <= suite["kendall"]["high"] <= 1.0
        places = {policy["name"]: policy["place"] for policy in source["policies"]}
        assert sorted(places.values()) == [1, 2, 3, 4]
        assert places[source["winner"]["policy"]] == 1
        assert places[suite["winner"]["policy"]] == suite["winner"]["place"]
        assert source["human_human_rmse_mm"]["value"] > 0.0
    (quick,) = content["suites"]
    assert (quick["lifts"], quick["shipped"]) == (12, [])
    assert content["policies"] == [policy["name"] for policy in quick["policies"]]
    assert content["policies"][-1] == "hold"
    assert done.stdout == colift("validity", *files, *FEW, "--json", "--jobs", "2").stdout


def test_a_failing_policy_counts_as_worst_and_is_reported(colift, files, tmp_path):
    path = tmp_path / "bad.py"
    path.write_text(
        "class Bad:\n"
        "    def reset(self, seed): pass\n"
        "    def act(self, observation): raise KeyError('oops')\n"
    )
    named = ("--policies", f"copy,hold,reactive,{path}:Bad", "--suite", "quick-v1")
    done = colift("validity", files[1], *named, "--json")
    assert done.returncode == 1
    assert "Bad: 3 of 3 lifts of hasty failed and count as worst" in done.stderr
    assert "Bad: 12 of 12 lifts of quick-v1 failed" in done.stderr
    (source,) = json.loads(done.stdout)["sources"]
    assert source["policies"][-1]["name"] == "Bad"


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["nowhere.csv"], "nowhere.csv: cannot be read"),
        (["hasty.csv", "hasty.csv"], "2 sources are called 'hasty'"),
        (["one.csv"], "one.csv has 1 lift; intervals need 2 or more"),
        (["hasty.csv", "--policies", "copy,hold,blend"], "needs 4 policies or more, got 3"),
        (["hasty.csv", "--policies", "copy,hold,blend,copy"], "copy is named twice"),
        (["hasty.csv", "--policies", "copy,hold,blend,nonesuch"], "nonesuch"),
        (["hasty.csv", "--suite", "nonesuch"], "quick-v1"),
        (["hasty.csv", "--jobs", "0"], "jobs must be at least 1"),
        ([], "DATA"),
    ],
)
def test_wrong_usage_is_refused_before_anything_is_played(colift, files, tmp_path, arguments, told):
    write(tmp_path / "one.csv", lambda u: u, trials=1)
    done = colift("validity", *arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert told in done.stderr


def test_parameters_belong_to_the_policy_before_them():
    assert separated("copy,blend,forgetting=0.9,rho=1, hold") == [
        "copy",
        "blend,forgetting=0.9,rho=1",
        "hold",
    ]


def test_shipped_scores_of_colifts_own_policies_are_not_played_again(colift, files):
    named = ("--policies", "copy,hold,reactive,reactive,position_step=0.01", "--suite", "paper-v1")
    content = json.loads(colift("validity", files[1], *named, "--json").stdout)
    (suite,) = content["suites"]
    assert (suite["lifts"], suite["shipped"]) == (50, ["copy", "hold", "reactive"])
    season = PlayedSeason.read("paper-v1")
    rows = {each.entry.name: each.entry.row for each in season.played}
    found = {policy["name"]: policy["rmse_mm"]["value"] for policy in suite["policies"]}
    for name in suite["shipped"]:
        assert found[name] == pytest.approx(rows[name].public.rmse_mm.mean, abs=0.01)
    assert len(found) == 4


@pytest.mark.parametrize(
    ("name", "lines"),
    [
        ("hdm05", ["hdm05"]),
        ("heldout_hdm05", ["heldout_", "hdm05"]),
        ("heldout_buetepage_hr", ["heldout_", "buetepage_", "hr"]),
        ("our people", ["our people"]),
        ("two-people-2027", ["two-people-", "2027"]),
    ],
)
def test_a_sources_name_is_broken_between_its_parts(name, lines):
    assert source_heading(name).split("\n") == lines


def test_lifts_as_recorded_stand_beside_the_recorded_pairs(colift, tmp_path):
    path = write(tmp_path / "pairs.csv", lambda u: 0.6 * math.sin(math.pi * u) ** 2)
    first, *rows = path.read_text().splitlines()
    far = [f"{row},{0.9 * float(row.split(',')[2]):.5f}" for row in rows]
    path.write_text("\n".join([f"{first},z_far_m", *far]) + "\n")
    scaled, own = (colift("validity", path, *FEW, *more) for more in ((), ("--as-recorded",)))
    assert "recorded pairs themselves" not in scaled.stdout
    assert "pairs as recorded: 4 lifts, two people " in own.stdout
    assert "The recorded pairs themselves: " in own.stdout
    assert "of that, the simulated two people " in own.stdout
