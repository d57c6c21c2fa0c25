"""``colift inspect`` and ``colift render`` of a bundle: from a score to its worst lifts."""

import csv
import json
import re
import shutil

import pytest

from ..benchmark.verification.forging import edit_arrays, edit_rows, mend


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Return a bundle of the command line."""
    from colift.agents.loading.policy_spec import PolicySpec
    from colift.benchmark.bundle import results, write_bundle
    from colift.benchmark.execution.runner import run_suite
    from colift.benchmark.results.baselines import HUMAN_HUMAN, shipped_baselines
    from colift.benchmark.suites.suite import make_suite

    suite = make_suite("quick-v1")
    run, baselines = run_suite(PolicySpec(text="copy"), suite), shipped_baselines(suite)
    folder = tmp_path_factory.mktemp("made") / "copy"
    content = results(run, baselines).plain()
    write_bundle(folder, run, content, human_human=baselines[HUMAN_HUMAN])
    return folder


@pytest.fixture
def bundle(made, tmp_path):
    return shutil.copytree(made, tmp_path / "mine")


def rows(folder):
    with (folder / "episodes.csv").open(newline="") as file:
        return sorted(csv.DictReader(file), key=lambda row: -float(row["rmse_mm"]))


def name(row):
    return f"{row['behaviour']}/{row['subject']} seed {row['seed']}"


def test_one_command_leads_from_a_bundle_to_its_three_worst_moments(colift, bundle):
    done = colift("inspect", "mine", "--jobs", "1", COLUMNS="200")
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    for row in rows(bundle)[:3]:
        (line,) = [line for line in lines if name(row) in line]
        cells = line.split(name(row))[1].split()
        assert cells[:2] == [
            f"{float(row['rmse_mm']):.1f}",
            f"{float(row['human_human_rmse_mm']):.1f}",
        ]
        assert re.fullmatch(r"\d+\.\d\d", cells[2])
        assert re.fullmatch(r"[+-]\d+", cells[3])
    assert "lower" in done.stdout
    assert "'colift verify'" in done.stdout
    assert "Next: colift render mine --worst 3 --out worst.html" in done.stdout


def test_the_page_is_written_and_the_folder_is_as_it_was(colift, bundle, tmp_path):
    before = {path.name: path.read_bytes() for path in bundle.iterdir()}
    done = colift("inspect", "mine", "--worst", "1", "--out", "why.html", "--jobs", "1")
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "why.html").read_text()
    assert page.count("data:image/png") == 1
    assert "Strengths and weaknesses" in page
    assert {path.name: path.read_bytes() for path in bundle.iterdir()} == before


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("inspect", "copy"), "copy: no such folder; name that of a result bundle"),
        (("inspect", "."), ". has no results.json: name the folder of a result bundle"),
        (("inspect", "mine", "--worst", "0"), "--worst must be 1 or more, got 0"),
        (("inspect", "mine", "--out", "why.png"), "its suffix must be .html"),
        (("inspect", "mine", "--out", "no/why.html"), "there is no folder no"),
        (("render", "mine", "--worst", "0", "--out", "x.png"), "--worst must be 1 or more, got 0"),
        (("render", "mine", "--seed", "1", "--out", "x.png"), "--seed is for a policy: mine is a"),
        (("render", "mine", "--worst", "2", "--out", "x.png"), "2 lifts do not fit into x.png"),
        (("render", "mine", "--out", "x.bmp"), "its suffix must be one of"),
        (("render", "copy", "--worst", "2", "--out", "x.png"), "copy is none"),
        (("render", ".", "--out", "x.png"), "has no policy.toml"),
    ],
)
def test_what_cannot_be_shown_is_refused_in_one_line(colift, bundle, tmp_path, arguments, said):
    done = colift(*arguments)
    assert done.returncode == 2
    assert said in done.stderr
    assert done.stderr.count("\n") == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mine"]


def test_a_damaged_bundle_is_refused(colift, bundle):
    (bundle / "episodes.csv").write_text("damaged")
    for command in (("inspect", "mine"), ("render", "mine", "--out", "x.png")):
        done = colift(*command)
        assert done.returncode == 2
        assert "mine: episodes.csv" in done.stderr


def test_the_worst_lift_of_a_bundle_is_drawn_without_its_policy(colift, bundle, tmp_path):
    done = colift("render", "mine", "--out", "worst.png")
    assert (done.returncode, done.stderr) == (0, "")
    worst = rows(bundle)[0]
    assert done.stdout == f"worst.png: {name(worst)}, RMSE {float(worst['rmse_mm']):.1f} mm\n"
    assert (tmp_path / "worst.png").read_bytes().startswith(b"\x89PNG")


def test_several_lifts_are_one_page_or_a_folder_of_pictures(colift, bundle, tmp_path):
    assert colift("render", "mine", "--worst", "2", "--out", "worst.html").returncode == 0
    data = re.search('id="replay-data">(.*?)</script>', (tmp_path / "worst.html").read_text())
    shown = [
        f"{each['behaviour']}/{each['subject']} seed {each['seed']}"
        for each in json.loads(data[1])["replays"]
    ]
    assert shown == [name(row) for row in rows(bundle)[:2]]
    assert colift("render", "mine", "--worst", "2", "--out", "pictures").returncode == 0
    files = sorted(path.name for path in (tmp_path / "pictures").iterdir())
    assert [each[:2] for each in files] == ["1-", "2-"]
    assert files[0] == f"1-{name(rows(bundle)[0]).replace('/', '-').replace(' ', '-')}.png"


def test_a_lift_that_does_not_follow_from_its_actions_is_said_to(colift, bundle):
    def better(table):
        max(table, key=lambda row: float(row["rmse_mm"]))["rmse_mm"] = "99.5"

    edit_rows(bundle, better)
    mend(bundle)
    done = colift("render", "mine", "--out", "worst.png")
    assert done.returncode == 0
    assert "note: it does not follow from the actions: episodes.csv" in done.stderr
    assert "99.5" in done.stderr
    assert "RMSE 99.5" not in done.stdout

    def higher(arrays):
        arrays["robot_end"][:] += 0.01

    edit_arrays(bundle, higher)
    mend(bundle)
    done = colift("render", "mine", "--out", "worst.png")
    assert "note: it does not follow from the actions: traces.npz" in done.stderr
