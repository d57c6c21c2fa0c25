"""The result bundle: complete, reproducible, all or nothing."""

import csv
import hashlib
import json

import numpy as np
import pytest
from colift.agents.errors import InputError
from colift.agents.policies.loading import PolicySpec
from colift.benchmark.bundle import FILES, check_target, results, write_bundle
from colift.benchmark.runner import run_suite
from colift.benchmark.suite import make_suite


@pytest.fixture(scope="module")
def run():
    return run_suite(PolicySpec(text="copy"), make_suite("quick-v1"))


@pytest.fixture
def bundle(run, tmp_path):
    folder = tmp_path / "deep" / "bundle"
    write_bundle(folder, run, results(run, {}))
    return folder


def test_it_holds_what_the_design_says(run, bundle):
    assert sorted(path.name for path in bundle.iterdir()) == sorted(FILES)
    content = json.loads((bundle / "results.json").read_text())
    assert content["suite"] == "quick-v1"
    assert content["suite_digest"] == run.suite.digest
    assert content["policy"]["name"] == "copy"
    summary = content["summary"]
    assert summary["episodes"] == 12
    assert summary["failed"] == 0
    low, high = summary["rmse_mm"]["ci95"]
    assert low < summary["rmse_mm"]["mean"] < high
    rmse = [episode.scores.rmse_mm for episode in run.episodes]
    assert summary["rmse_mm"]["mean"] == pytest.approx(np.mean(rmse))
    assert [group["behaviour"] for group in content["groups"]] == [
        "smooth",
        "pause",
        "jerky",
        "changing_goal",
    ]
    assert content["groups"][1]["rmse_mm"]["mean"] == pytest.approx(np.mean(rmse[3:6]))


def test_the_manifest_has_the_hash_of_every_other_file(bundle):
    manifest = json.loads((bundle / "manifest.json").read_text())
    for name in set(FILES) - {"manifest.json"}:
        data = (bundle / name).read_bytes()
        assert manifest["sha256"][name] == hashlib.sha256(data).hexdigest()


def test_the_scores_follow_from_the_traces(bundle):
    with (bundle / "episodes.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    with np.load(bundle / "traces.npz", allow_pickle=False) as traces:
        ends = np.cumsum(traces["frames"])
        gaps = np.split(1000 * (traces["human_end"] - traces["robot_end"]), ends[:-1])
        assert len(traces["action"]) == traces["steps"].sum()
    for row, gap in zip(rows, gaps, strict=True):
        assert float(row["rmse_mm"]) == pytest.approx(np.sqrt(np.mean(gap**2)))


def test_equal_runs_give_equal_files(run, bundle, tmp_path):
    again = run_suite(PolicySpec(text="copy"), make_suite("quick-v1"))
    write_bundle(tmp_path / "again", again, results(again, {}))
    for name in ("episodes.csv", "traces.npz"):
        assert (tmp_path / "again" / name).read_bytes() == (bundle / name).read_bytes()


def test_an_older_bundle_is_replaced_and_other_things_are_left_alone(run, bundle, tmp_path):
    write_bundle(bundle, run, results(run, {}))
    assert sorted(path.name for path in bundle.parent.iterdir()) == ["bundle"]
    (bundle / "thesis.tex").write_text("precious")
    with pytest.raises(InputError, match=r"thesis\.tex"):
        write_bundle(bundle, run, results(run, {}))
    assert (bundle / "thesis.tex").read_text() == "precious"


def test_a_file_in_the_way_is_refused(tmp_path):
    (tmp_path / "there").write_text("")
    with pytest.raises(InputError, match="is a file"):
        check_target(tmp_path / "there")
    with pytest.raises(InputError, match="cannot write"):
        check_target(tmp_path / "there" / "below")


def test_a_policy_without_smoothness_has_none_in_the_bundle(tmp_path):
    still = run_suite(PolicySpec(text="hold"), make_suite("quick-v1").with_seeds(0, 1))
    content = results(still, {})
    assert content["summary"]["sparc"] == {"mean": None, "missing": 4}
    write_bundle(tmp_path / "still", still, content)
    with (tmp_path / "still" / "episodes.csv").open(newline="") as file:
        assert {row["sparc"] for row in csv.DictReader(file)} == {""}
