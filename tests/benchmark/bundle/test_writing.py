"""The result bundle: complete, reproducible, all or nothing."""

import csv
import dataclasses
import hashlib
import json

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.benchmark.bundle import FILES, check_bundle_folder, read_bundle, results, write_bundle
from colift.benchmark.bundle.content import real_time
from colift.benchmark.episode.metric import SCORING
from colift.benchmark.execution.provenance import fingerprint
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import HUMAN_HUMAN, play_baselines
from colift.benchmark.statistics import MeanWithMissing
from colift.benchmark.suites.suite import make_suite


@pytest.fixture(scope="module")
def run():
    return run_suite(PolicySpec(text="copy"), make_suite("quick-v1"))


@pytest.fixture
def bundle(run, tmp_path):
    folder = tmp_path / "deep" / "bundle"
    write_bundle(folder, run, results(run, {}).plain())
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
    rmse = [episode.scores["rmse_mm"] for episode in run.episodes]
    assert summary["rmse_mm"]["mean"] == pytest.approx(np.mean(rmse))
    groups = [(group["behaviour"], group["subject"]) for group in content["groups"]]
    assert groups == [(each.behaviour, each.subject) for each in run.episodes]
    assert [group["rmse_mm"]["mean"] for group in content["groups"]] == pytest.approx(rmse)


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
    write_bundle(tmp_path / "again", again, results(again, {}).plain())
    for name in ("episodes.csv", "traces.npz"):
        assert (tmp_path / "again" / name).read_bytes() == (bundle / name).read_bytes()


def test_an_older_bundle_is_replaced_and_other_things_are_left_alone(run, bundle, tmp_path):
    write_bundle(bundle, run, results(run, {}).plain())
    assert sorted(path.name for path in bundle.parent.iterdir()) == ["bundle"]
    (bundle / "thesis.tex").write_text("precious")
    with pytest.raises(InputError, match=r"thesis\.tex"):
        write_bundle(bundle, run, results(run, {}).plain())
    assert (bundle / "thesis.tex").read_text() == "precious"


def test_a_file_in_the_way_is_refused(tmp_path):
    (tmp_path / "there").write_text("")
    with pytest.raises(InputError, match="is a file"):
        check_bundle_folder(tmp_path / "there")
    with pytest.raises(InputError, match="cannot write"):
        check_bundle_folder(tmp_path / "there" / "below")


def test_a_policy_without_smoothness_has_none_in_the_bundle(tmp_path):
    still = run_suite(PolicySpec(text="hold"), make_suite("quick-v1").with_seeds(0, 1))
    content = results(still, {})
    assert content.summary.metrics["sparc"] == MeanWithMissing(mean=None, missing=12)
    write_bundle(tmp_path / "still", still, content.plain())
    with (tmp_path / "still" / "episodes.csv").open(newline="") as file:
        assert {row["sparc"] for row in csv.DictReader(file)} == {""}


def test_equal_runs_give_equal_bundles_up_to_the_step_times(run, bundle, tmp_path):
    slower = dataclasses.replace(
        run,
        episodes=tuple(
            dataclasses.replace(episode, step_times=(0.2,) * 5) for episode in run.episodes
        ),
    )
    write_bundle(tmp_path / "slower", slower, results(slower, {}).plain())
    one, other = (
        json.loads((folder / "results.json").read_text())
        for folder in (bundle, tmp_path / "slower")
    )
    assert one["summary"].pop("real_time") is True
    assert other["summary"].pop("real_time") is False
    assert one["summary"].pop("step_ms")["p99"] < 100
    assert other["summary"].pop("step_ms") == {"p50": pytest.approx(200), "p99": pytest.approx(200)}
    assert one == other


@pytest.mark.parametrize(("p99_ms", "keeps_up"), [(60.0, True), (60.1, False), (None, None)])
def test_a_robot_waits_for_a_policy_for_a_share_of_the_period(run, p99_ms, keeps_up):
    assert real_time(p99_ms, run.suite) is keeps_up


def test_circumstances_are_in_the_results(run):
    content = results(dataclasses.replace(run, isolation="bubblewrap", faults=2), {})
    assert content.isolation == "bubblewrap"
    assert content.evaluator_faults == 2
    assert content.scoring == SCORING


def test_the_manifest_says_how_the_episodes_are_made_and_where_they_were(run, bundle):
    manifest = json.loads((bundle / "manifest.json").read_text())
    assert manifest["recipe"]["seeds"] == [0]
    assert manifest["recipe"]["scenarios"][1] == "smooth/draw-2"
    assert manifest["platform"] == fingerprint()


def test_both_agents_actions_and_the_states_are_there_as_they_were(run, bundle):
    with np.load(bundle / "traces.npz", allow_pickle=False) as traces:
        for name in ("action", "human_action", "state"):
            parts = [getattr(episode.trace, name) for episode in run.episodes]
            assert traces[name].tobytes() == np.concatenate(parts).tobytes()
        assert traces["human_action"].shape[1] == 10


def test_an_incomplete_run_gives_a_bundle_that_says_so(run, tmp_path):
    part = dataclasses.replace(run, episodes=(run.episodes[1], run.episodes[7]))
    write_bundle(tmp_path / "part", part, results(part, {}).plain())
    bundle = read_bundle(tmp_path / "part")
    assert bundle.results["complete"] is False
    assert bundle.indices == (1, 7)


def test_a_failed_write_leaves_the_older_bundle(run, bundle, monkeypatch):
    def full(*arguments):
        raise OSError("no space left on device")

    before = {path.name: path.read_bytes() for path in bundle.iterdir()}
    monkeypatch.setattr(type(bundle), "write_bytes", full)
    with pytest.raises(OSError, match="no space"):
        write_bundle(bundle, run, results(run, {}).plain())
    assert {path.name: path.read_bytes() for path in bundle.iterdir()} == before
    assert [path.name for path in bundle.parent.iterdir()] == ["bundle"]


def test_what_a_hostile_policy_says_is_kept_where_it_does_no_harm(hostile_run, hostile):
    failed = sum(episode.failure is not None for episode in hostile_run.episodes)
    assert failed > 0
    text = (hostile / "episodes.csv").read_bytes().decode()
    assert text.count("\n") == 1 + len(hostile_run.episodes)
    assert all(c.isprintable() or c == "\n" for c in text)
    assert r"no\r\n" in text
    logs = json.loads((hostile / "logs.json").read_text())
    assert len(logs) == failed
    assert all(log.startswith("line one") for log in logs.values())
    with np.load(hostile / "traces.npz", allow_pickle=False) as traces:
        assert [name for name in traces if name.startswith("internals")] == ["internals/guess"]


def test_the_error_of_two_people_on_each_lift_is_written_and_read(run, bundle, tmp_path):
    human_human = play_baselines(run.suite)[HUMAN_HUMAN]
    content = results(run, {HUMAN_HUMAN: human_human}).plain()
    write_bundle(tmp_path / "new", run, content, human_human=human_human)
    with (tmp_path / "new" / "episodes.csv").open(newline="") as file:
        told = [float(row["human_human_rmse_mm"]) for row in csv.DictReader(file)]
    assert told == [*human_human.rmse_mm]
    assert read_bundle(tmp_path / "new").human_human_mm == tuple(told)
    assert read_bundle(bundle).human_human_mm is None
