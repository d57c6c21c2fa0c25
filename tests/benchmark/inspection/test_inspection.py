"""The inspection of a run: what it shows is what the lifts have."""

import dataclasses

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.policies.copy import Copy
from colift.agents.spec import InProcess
from colift.base.errors import InputError, PolicyError
from colift.benchmark.bundle import results
from colift.benchmark.execution.pool import local_pool
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.inspection.inspection import inspect_run
from colift.benchmark.inspection.page import inspection_page
from colift.benchmark.results.baselines import HUMAN_HUMAN, human_human_run, play_baselines
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.replays.replay import play_ghost

from .conftest import SUITE


class Failing(Copy):
    """Fails when the human's end is high."""

    def act(self, observation):
        if observation[0] > 0.1:
            raise PolicyError("too high")
        return super().act(observation)


class FailingSpec(InProcess):
    name = "failing"

    def check(self):
        pass

    def digest(self):
        return "0" * 16

    def make(self):
        return Failing()


class DeadSpec(FailingSpec):
    name = "dead"

    def make(self):
        raise PolicyError("cannot be made")


def test_the_worst_lifts_are_those_with_the_largest_error(run, found):
    errors = [each.scores["rmse_mm"] for each in run.episodes]
    assert [each.lift.rmse_mm for each in found.worst] == sorted(errors, reverse=True)[:3]
    for each in found.worst:
        assert each.lift.name.startswith(f"{each.episode.behaviour}/{each.episode.subject} seed")


def test_the_moment_is_that_of_the_largest_error_and_has_two_people_beside_it(found):
    for each in found.worst:
        trace = each.episode.trace
        gap = 1000 * (trace.robot_end - trace.human_end)
        assert abs(each.moment.error_mm) == np.abs(gap).max()
        assert each.moment.error_mm == gap[each.moment.frame]
        ghost = play_ghost(each.scenario, each.episode.seed)
        theirs = ghost.episode.trace
        assert each.moment.human_human_mm == pytest.approx(
            1000 * (theirs.robot_end - theirs.human_end)[each.moment.frame]
        )
        assert each.lift.human_human_mm == ghost.episode.scores["rmse_mm"]
        begun = [name for name, first in ghost.plan.events if first <= each.moment.frame]
        assert each.moment.doing.startswith(begun[-1])
        way = "up" if trace.human_velocity[each.moment.frame] > 0 else "down"
        assert f"{way} at " in each.moment.doing


def test_the_phases_have_the_whole_error(run, found):
    assert sum(each.time_share for each in found.phases) == pytest.approx(1.0)
    assert sum(each.error_share for each in found.phases) == pytest.approx(1.0)
    shares = [each.error_share for each in found.phases]
    assert shares == sorted(shares, reverse=True)
    traces = [each.trace for each in run.episodes]
    gaps = np.concatenate([each.robot_end - each.human_end for each in traces])
    pooled = sum(each.time_share * each.rmse_mm**2 for each in found.phases)
    assert pooled == pytest.approx(1e6 * np.mean(gaps**2))


def test_two_people_inspected_are_as_good_as_two_people():
    people = human_human_run(SUITE)
    people = dataclasses.replace(people, suite=SUITE)
    same = inspect_run(people, results(people, play_baselines(SUITE)))
    assert all(each.ratio == pytest.approx(1.0) for each in same.parts)
    assert all(each.rmse_mm == pytest.approx(each.human_human_mm) for each in same.phases)
    assert all(each.moment.error_mm == each.moment.human_human_mm for each in same.worst)


def test_the_parts_are_those_of_the_results(run, found, baselines):
    whole, *behaviours = found.parts
    assert whole.rmse_mm == found.results.summary.rmse_mm
    assert whole.human_human_mm == pytest.approx(np.mean(baselines[HUMAN_HUMAN].rmse_mm))
    assert [each.part.behaviour for each in behaviours] == [
        "smooth",
        "pause",
        "jerky",
        "changing_goal",
    ]


def test_a_part_of_a_run_is_inspected_with_two_people_on_that_part(run, baselines, found):
    rows = [1, 4, 6]
    part = dataclasses.replace(run, episodes=tuple(run.episodes[row] for row in rows))
    theirs = {name: each.select(rows) for name, each in baselines.items()}
    played = []
    some = inspect_run(part, results(part, theirs), worst=10, progress=played.append)
    assert sum(played) == len(some.worst) == 3
    for each in some.worst:
        row = run.episodes.index(each.episode)
        assert each.lift.human_human_mm == baselines[HUMAN_HUMAN].rmse_mm[row]
    assert "3 of 8 lifts" in str(some)


def test_a_failed_lift_has_the_moment_of_its_failure(baselines):
    run = run_suite(FailingSpec(), SUITE)
    found = inspect_run(run, results(run, baselines), worst=8)
    for each in found.worst:
        assert each.moment.frame == len(each.episode.trace.human_end) - 1
    ((reason, lifts),) = found.failures
    assert reason.endswith("too high")
    assert len(lifts) == 8
    assert "failed: rise" in str(found)
    assert str(found).count("too high") == 1


def test_a_policy_that_never_lifts_has_no_moments_and_no_pictures(baselines):
    run = run_suite(DeadSpec(), SUITE)
    found = inspect_run(run, results(run, baselines))
    assert [each.moment for each in found.worst] == [None] * 3
    assert found.phases == ()
    assert "failed before the first frame" in str(found)
    page = inspection_page(found)
    assert "data:image" not in page
    assert "It ended before its first frame: start: cannot be made" in page


def test_no_lift_cannot_be_shown(run, baselines):
    with pytest.raises(InputError, match="worst must be 1 or more, got 0"):
        inspect_run(run, results(run, baselines), worst=0)


def test_workers_find_the_same(run, baselines, found):
    with local_pool(2) as pool:
        again = inspect_run(run, results(run, baselines), executor=pool)
    assert str(again) == str(found)


@pytest.mark.parametrize(
    ("policy", "suite", "said"),
    [
        ("agree_leader", "agree-v1", "Robot's hurdle missed"),
        ("ball_steady", "ball-v1", "Error: ball from the target, towards the robot"),
    ],
)
def test_a_task_of_its_own_is_inspected_in_its_own_words(policy, suite, said):
    whole = make_suite(suite)
    few = dataclasses.replace(whole, scenarios=tuple(each for each in whole.scenarios[::25]))
    run = run_suite(PolicySpec(text=policy), few)
    found = inspect_run(run, results(run, play_baselines(few)), worst=2)
    text = str(found)
    assert said in text
    tilt = "tilt mm" in text
    assert tilt == (suite == "agree-v1")
