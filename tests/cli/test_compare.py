"""``colift compare`` and ``colift bench --policies`` as a user meets them."""

import json
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

QUICK = ("--suite", "quick-v1", "--jobs", "1")


def test_two_policies_are_ranked_against_each_other_and_people(colift, tmp_path: Path) -> None:
    out = tmp_path / "made" / "here"
    done = colift("compare", "hold", "copy", *QUICK, "--out", str(out))
    assert done.returncode == 0
    assert done.stderr == ""
    names = ("oracle", "best known (trained)", "two people", "copy", "hold")
    places = [done.stdout.index(f" {name} ") for name in names]
    assert places == sorted(places)
    for told in ("Behind copy", "vs_human", "changing_goal", "none", "copy is the most level"):
        assert told in done.stdout
    assert f"{out / 'compare.html'}" in done.stdout
    assert (
        "No policy is marked as the best: 3 people are too few for any difference." in done.stdout
    )
    assert "*" not in done.stdout
    assert not any(line.endswith(" ") for line in done.stdout.splitlines())
    content = json.loads((out / "compare.json").read_text())
    assert [policy["name"] for policy in content["policies"]] == ["copy", "hold"]
    assert (out / "compare.png").read_bytes().startswith(b"\x89PNG")


def test_where_no_people_are_enough_there_are_no_ranks(colift) -> None:
    done = colift("compare", "hold", "copy", *QUICK, "--seeds", "0:1", COLUMNS="200")
    assert "No ranks: 3 people are too few for any difference beyond chance." in done.stdout
    assert "But 3 people are too few to rank the policies." in done.stdout
    (copy, *_) = (line for line in done.stdout.splitlines() if line.split()[:1] == ["copy"])
    assert copy.startswith("     copy")


def test_json_is_alone_on_stdout(colift) -> None:
    done = colift("compare", "copy", "hold", *QUICK, "--seeds", "0:1", "--json")
    content = json.loads(done.stdout)
    assert content["episodes"] == 12
    assert content["suite"] == "quick-v1[0:1]"


def test_policies_are_compared_as_run_plays_them(colift) -> None:
    options = (*QUICK, "--seeds", "0:1", "--latency", "0.05", "--control-period", "0.05", "--json")
    both = json.loads(colift("compare", "copy", "hold", *options, "--isolation", "limits").stdout)
    alone = json.loads(colift("run", "copy", *options).stdout)
    assert (
        both["suite"] == alone["suite"] == "quick-v1[0:1] (latency 0.05 s, control_period 0.05 s)"
    )
    (copy,) = (each for each in both["policies"] if each["name"] == "copy")
    assert copy["rmse_mm"]["mean"] == alone["summary"]["rmse_mm"]["mean"]


def test_a_cluster_gives_the_same_comparison(colift, dask_address) -> None:
    def compared(*place: str) -> object:
        done = colift("compare", "copy", "hold", "--suite", "quick-v1", *place, "--json")
        assert done.returncode == 0, done.stderr
        content = json.loads(done.stdout)
        for policy in content["policies"]:
            del policy["step_ms"]
        return content

    assert compared("--dask", dask_address) == compared("--jobs", "1")


def test_recordings_are_compared(colift, tmp_path: Path) -> None:
    path = tmp_path / "lifts.csv"
    lines = [f"a,{k / 50:.2f},{0.3 * min(k, 60 - k) / 30:.3f}\n" for k in range(61)]
    path.write_text("trial,t_s,z_m\n" + "".join(lines))
    done = colift("compare", "copy", "hold", "--recordings", str(path), "--jobs", "1")
    assert done.returncode == 0
    assert "RMSE mm on each behaviour" not in done.stdout
    assert "copy is the most level" in done.stdout


def test_failed_lifts_are_said_and_the_rest_is_compared(colift, tmp_path: Path) -> None:
    path = tmp_path / "bad.py"
    path.write_text(
        "class Bad:\n"
        "    def reset(self, seed): pass\n"
        "    def act(self, observation): raise KeyError('oops')\n"
    )
    done = colift("compare", f"{path}:Bad", "hold", *QUICK, "--seeds", "0:1")
    assert done.returncode == 1
    assert "Bad: 12 of 12 lifts failed and count as worst" in done.stderr
    assert "KeyError: 'oops'" in done.stderr
    assert "hold is the most level" in done.stdout


def test_classes_of_one_name_are_told_apart_by_their_files(colift, tmp_path: Path) -> None:
    text = "class Mine:\n    def reset(self, seed): pass\n    def act(self, o): return [0.0]\n"
    for name in ("a.py", "b.py"):
        (tmp_path / name).write_text(text)
    options = (*QUICK, "--seeds", "0:1", "--json")
    done = colift("compare", "a.py:Mine", "b.py:Mine", *options, cwd=tmp_path)
    names = {policy["name"] for policy in json.loads(done.stdout)["policies"]}
    assert names == {"a.py:Mine", "b.py:Mine"}


def test_all_takes_every_registered_policy_beside_those_named(colift) -> None:
    listed = colift("compare", "hold", "--all", *QUICK, "--seeds", "0:1", "--json")
    names = [policy["name"] for policy in json.loads(listed.stdout)["policies"]]
    assert {"blend", "copy", "hold", "proactive", "random", "reactive"} <= set(names)
    assert len(names) == len(set(names))


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ([], "at least two policies, or --all"),
        (["copy"], "only copy was named"),
        (["copy", "hold", "copy"], "policy copy is named twice"),
        (["copy", "nonesuch"], "unknown policy 'nonesuch'"),
        (["copy", "hold", "--seeds", "0:1", "--recordings", "x.csv"], "exclude each other"),
        (["copy", "hold", "--out", "/dev/null"], "cannot be a folder"),
        (["copy", "hold", "--resume"], "--resume needs the --out of the comparison"),
        (["copy", "hold", "--resume", "--out", "x"], "there is no interrupted run of x"),
        (["copy", "hold", "--isolation", "nonesuch"], "unknown isolation 'nonesuch'"),
        (["copy", "hold", "--latency", "-1"], "latency"),
    ],
)
def test_wrong_usage_is_one_clear_line(
    colift, arguments: list[str], told: str, tmp_path: Path
) -> None:
    done = colift("compare", *arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr.startswith("error: ")
    assert done.stderr.count("\n") == 1
    assert told in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_bench_times_every_registered_policy(colift) -> None:
    done = colift("bench", "--policies", "--json")
    content = json.loads(done.stdout)
    assert (done.returncode == 0) == all(
        each["within_limit"] for each in content["policies"].values()
    )
    assert content["limit_ms"] == 10.0
    assert {"blend", "copy", "hold"} <= set(content["policies"])
    for taken in content["policies"].values():
        assert 0.0 < taken["median_ms"] <= taken["p99_ms"]
        assert taken["within_limit"] == (taken["p99_ms"] <= 10.0)


def test_bench_does_one_thing_at_a_time(colift) -> None:
    done = colift("bench", "--policies", "--convergence")
    assert done.returncode == 2
    assert "--convergence and --policies" in done.stderr


def test_bench_has_a_suite_for_the_convergence_alone(colift) -> None:
    done = colift("bench", "--suite", "ball-v1")
    assert done.returncode == 2
    assert "--suite belongs to --convergence" in done.stderr


def test_a_bundle_is_compared_as_it_is(colift, tmp_path: Path) -> None:
    for name in ("hold", "copy"):
        colift("run", name, *QUICK, "--seeds", "0:2", "--out", name + "s")
    one = colift("compare", "holds", "copys", "--json")
    assert one.returncode == 0, one.stderr
    played = colift("compare", "hold", "copy", *QUICK, "--seeds", "0:2", "--json")
    contents = [json.loads(each.stdout) for each in (one, played)]
    for content in contents:
        for policy in content["policies"]:
            del policy["step_ms"]
    assert contents[0] == contents[1]
    mixed = colift("compare", "holds", "hold", "copys")
    assert mixed.returncode == 0, mixed.stderr
    assert "copy: from copys, not simulated again" in mixed.stdout
    assert "holds: from holds, not simulated again" in mixed.stdout
    for arguments, told in (
        (("--suite", "quick-v1"), "holds has the lifts of quick-v1[0:2] (digest "),
        (("--seeds", "0:3"), "not of standard-v1[0:3]"),
    ):
        done = colift("compare", "holds", "copy", *arguments)
        assert (done.returncode, done.stdout) == (2, "")
        assert told in done.stderr
    (tmp_path / "holds" / "episodes.csv").write_text("damaged")
    done = colift("compare", "holds", "copys")
    assert done.returncode == 2
    assert done.stderr.startswith("error: holds: episodes.csv: ")
