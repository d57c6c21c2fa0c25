"""The baselines (the human-human baseline, hold, copy), and the references shipped with them."""

import dataclasses
import gc
import json

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.registry import SUITES, own_entries
from colift.benchmark.bundle import results
from colift.benchmark.comparison.playing import play_references
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import on_boards
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.paper.table_one import HUMAN_HUMAN_RMSE
from colift.benchmark.references.catalogue import suite_references
from colift.benchmark.results.baselines import (
    HUMAN_HUMAN,
    ToShip,
    baselines_json,
    human_human_run,
    play_baselines,
    shipped_baselines,
    shipped_references,
)
from colift.benchmark.suites.suite import make_suite


@pytest.fixture(scope="module")
def quick():
    return make_suite("quick-v1")


@pytest.fixture(scope="module")
def played(quick):
    return play_baselines(quick)


def test_lifts_of_baselines_are_scored_as_they_end_and_not_kept(quick):
    alive = []

    def look(episodes):
        played = (each for each in gc.get_objects() if isinstance(each, Episode))
        alive.append(sum(each.seed in range(70, 74) for each in played))

    play_baselines(
        dataclasses.replace(quick, scenarios=quick.scenarios[:1], seeds=tuple(range(70, 74))),
        progress=look,
    )
    assert len(alive) == 12
    assert 0 < max(alive) <= 2


@pytest.mark.parametrize("name", own_entries(SUITES))
def test_every_suite_has_its_baselines_shipped(name):
    suite = make_suite(name)
    shipped = shipped_baselines(suite)
    assert set(shipped) == {"human_human", "hold", "copy"}
    references = shipped_references(suite)
    assert set(references) == set(suite_references(suite)) >= {"oracle"}
    for baseline in (*shipped.values(), *references.values()):
        counted = sum(map(suite.counts, range(suite.size)))
        assert len(baseline.rmse_mm) == len(baseline.strata) == counted
        assert len(baseline.lifts_mm) == suite.size
        assert baseline.means.keys() == {metric.name for metric in on_boards(suite.metrics)}


def test_the_shipped_ones_are_what_the_code_gives(quick, played):
    """If this fails, a number has changed: run ``colift baselines``."""
    for name, baseline in shipped_baselines(quick).items():
        assert baseline.rmse_mm == pytest.approx(played[name].rmse_mm, rel=1e-6)
        assert baseline.strata == played[name].strata
        assert baseline.means.keys() == played[name].means.keys()
        for metric, value in played[name].means.items():
            if value is None:
                assert baseline.means[metric] is None
            else:
                assert baseline.means[metric] == pytest.approx(value, rel=1e-6)


def test_the_shipped_references_are_what_the_code_gives(quick):
    """If this fails, the reference was learned anew or a number has changed: as above."""
    some = dataclasses.replace(quick.with_seeds(0, 1), scenarios=quick.scenarios[1:2])
    for name, played in play_references(suite_references(some), some).items():
        shipped = shipped_references(quick)[name]
        at = shipped.strata.index(played.strata[0])
        assert shipped.rmse_mm[at] == pytest.approx(played.rmse_mm[0], rel=1e-6)


def test_other_episodes_have_none_shipped(quick):
    assert shipped_baselines(quick.with_seeds(100, 103)) is None
    assert shipped_baselines(quick.with_timing(0.05, None)) is None


def test_the_shipped_file_can_be_read_back(quick, played):
    references = {"copy": played["copy"]}
    content = json.loads(
        baselines_json([ToShip(suite=quick, baselines=played, references=references)])
    )
    assert content[quick.digest]["suite"] == "quick-v1"
    assert list(content[quick.digest]["references"]) == ["copy"]
    assert content[quick.digest]["baselines"]["copy"]["rmse_mm"] == list(played["copy"].rmse_mm)


def test_the_human_human_baseline_has_the_papers_error_on_the_papers_suite():
    """Calibrated on other seeds: 6.5 +- 0.7 mm."""
    human_human = shipped_baselines(make_suite("paper-v1"))[HUMAN_HUMAN]
    assert human_human.mean == pytest.approx(HUMAN_HUMAN_RMSE, abs=0.7)


def test_the_human_human_baseline_meets_the_plans_that_the_robot_meets(quick):
    human_human = human_human_run(quick.with_seeds(0, 1))
    robot = run_suite(PolicySpec(text="copy"), quick.with_seeds(0, 1))
    pairs = zip(human_human.episodes, robot.episodes, strict=True)
    assert all(a.trace.target.tobytes() == b.trace.target.tobytes() for a, b in pairs)


def test_the_human_human_baseline_beats_copying_wherever_the_human_moves_smoothly(played):
    human_human, copy = (played[name].by_stratum for name in (HUMAN_HUMAN, "copy"))
    for stratum in human_human:
        if stratum[0] != "jerky":
            assert human_human[stratum].mean < 0.6 * copy[stratum].mean


def test_vs_human_is_the_mean_ratio_lift_by_lift_with_a_paired_interval(quick, played):
    run = run_suite(PolicySpec(text="copy"), quick)
    content = results(run, played)
    versus = content.summary.vs_human
    human_human = played[HUMAN_HUMAN]
    logs = np.log(np.divide(played["copy"].rmse_mm, human_human.rmse_mm))
    assert versus.mean == pytest.approx(np.exp(logs.mean()))
    low, high = versus.ci95
    assert 1 < low < versus.mean < high
    assert content.strata[0].vs_human == pytest.approx(np.exp(logs[0]))
    assert content.strata[0].human_human_rmse_mm == pytest.approx(human_human.rmse_mm[0])
    assert content.baselines[HUMAN_HUMAN].mean == pytest.approx(human_human.mean)


def test_the_human_human_baseline_against_itself_is_exactly_one(quick, played):
    run = human_human_run(quick)
    against = results(dataclasses.replace(run, suite=quick), played).summary.vs_human
    assert against.mean == pytest.approx(1.0)
    assert against.ci95 == pytest.approx([1.0, 1.0])
