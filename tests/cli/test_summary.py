"""``colift summary``: a column for each suite, and no mean over them."""

import dataclasses
import json

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import results, write_bundle
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import HUMAN_HUMAN, human_human_run
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import make_suite

PLAYED = {
    "level": ("copy", "quick-v1"),
    "intent": ("copy", "intent-v1"),
    "own": ("pose_wrist", "intent-v1"),
}


@pytest.fixture(scope="module")
def bundles(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bundles")
    for name, (policy, suite) in PLAYED.items():
        few = make_suite(suite).with_seeds(0, 1)
        few = dataclasses.replace(few, scenarios=few.scenarios[:1])
        human_human = {HUMAN_HUMAN: ScoreTable.of(human_human_run(few))}
        run = run_suite(PolicySpec(text=policy), few)
        write_bundle(folder / name, run, results(run, human_human).plain())
    return folder


def test_each_policy_has_its_ratio_on_each_suite(colift, bundles):
    done = colift("summary", *(bundles / name for name in PLAYED))
    assert done.returncode == 0, done.stderr
    (copy,) = [line.split() for line in done.stdout.splitlines() if line.strip().startswith("copy")]
    (own,) = [line.split() for line in done.stdout.splitlines() if "pose_wrist" in line]
    assert len(copy) == 3
    assert own[1] == "none"
    assert "no mean over suites" in " ".join(done.stdout.split())
    told = json.loads(colift("summary", *(bundles / name for name in PLAYED), "--json").stdout)
    assert [each["suite"] for each in told] == [f"{suite}[0:1]" for _, suite in PLAYED.values()]
    assert f"{told[0]['vs_human']['mean']:.2f}" == copy[1]


def test_two_results_of_one_cell_are_refused(colift, bundles):
    done = colift("summary", bundles / "level", bundles / "level")
    assert done.returncode == 2
    assert "are both of copy on quick-v1" in " ".join(done.stderr.split())


def test_what_is_no_bundle_is_named(colift, tmp_path):
    done = colift("summary", tmp_path)
    assert done.returncode == 2
    assert str(tmp_path) in done.stderr.replace("\n", "")
    done = colift("summary", "copy")
    assert done.returncode == 2
    assert done.stderr == "error: copy: no such folder; name that of a result bundle\n"
