"""The task of two hurdles: its lifts, its scores, and how its policies and people fare."""

import contextlib
import dataclasses
import math
import subprocess
import sys

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.tasks.agree.observation import AgreeObservation
from colift.agents.tasks.touch.observation import HapticObservation
from colift.base.errors import InputError
from colift.benchmark.admission import published
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.replay import replay
from colift.benchmark.results.baselines import human_human_run, partner_spec
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.agree.hurdles import Hurdle
from colift.benchmark.tasks.agree.oracle import foreknow_agreement
from colift.benchmark.tasks.agree.scores import (
    agreement_ms,
    agreement_rmse_mm,
    leading_mw,
    missed_mm,
)
from colift.benchmark.tasks.agree.task import Agree
from colift.testing import check_suite, check_task

pytestmark = pytest.mark.slow

DIGEST = "8be3f3907d590b85"
SEED = 100_000
BOTH = ("abreast", "ahead", "behind")


def lifted(behaviour, subject="S1", policy="agree_game", seed=SEED, uncertainty=None):
    """Return a lift with a policy, or with a second person."""
    partner = "human" if policy is None else "nao"
    scenario = make_scenario(behaviour, subject, partner, task="agree")
    if uncertainty is not None:
        scenario = dataclasses.replace(scenario, task=Agree(uncertainty=uncertainty))
    agent = partner_spec(scenario) if policy is None else PolicySpec(text=policy)
    with contextlib.closing(Lift(scenario)) as lift, agent.agent() as holder:
        return run_episode(lift, holder, seed)


def test_the_suite_is_what_it_was():
    """A change here is a new suite: bundles of the old one no longer belong to it."""
    assert make_suite("agree-v1").digest == DIGEST


def test_task_and_suite_conform():
    check_task(Agree(), "abreast")
    check_task(Agree(), "own_hurdle")
    check_suite(make_suite("agree-v1"))


def test_half_of_the_lifts_have_two_secrets_a_third_one_and_a_sixth_none():
    suite = make_suite("agree-v1")
    plans = [each.human.plan(each.subject, 0) for each in suite.scenarios]
    secrets = [(plan.own is not None) + (plan.other is not None) for plan in plans]
    assert [secrets.count(n) / len(secrets) for n in (2, 1, 0)] == [1 / 2, 1 / 3, 1 / 6]


def test_the_first_seven_numbers_are_those_of_touch():
    names = [each.name for each in AgreeObservation]
    assert names[: len(HapticObservation)] == [each.name for each in HapticObservation]


def test_the_robot_has_its_own_hurdle_and_not_the_human_s():
    with contextlib.closing(Lift(make_scenario("abreast", "S1", task="agree"))) as lift:
        lift.reset(SEED)
        lift.frame = 100
        own = lift.partner_observation()[AgreeObservation.HURDLE_HEIGHT :]
        hurdle = lift.plan.other
        expected = hurdle.height, hurdle.start / 100 - 1, hurdle.stop / 100 - 1, 1.0
        assert own == pytest.approx(np.array(expected))
        assert lift.human_observation()[0] == lift.plan.own.height


def test_the_whole_table_has_to_stay_in_the_window():
    hurdle = Hurdle(0.2, 10, 50)
    near, far = np.full(80, 0.15), np.full(80, 0.15)
    near[15:35], far[15:35] = 0.2, 0.17
    near[55:] = far[55:] = 0.2
    assert missed_mm(hurdle, near, far) == pytest.approx(30 / math.sqrt(2))
    assert missed_mm(hurdle, near[:25], far[:25]) == 250.0
    assert math.isnan(missed_mm(None, near, far))


def test_to_cross_a_hurdle_is_not_to_pass_it():
    crossing = 0.2 + 0.1 * (np.arange(60) - 29.5) / 100
    assert missed_mm(Hurdle(0.2, 10, 50), crossing, crossing) == pytest.approx(5.77, abs=0.01)


def test_the_error_is_the_rms_of_what_a_lift_has_and_failed_frames_count():
    assert agreement_rmse_mm((3.0, math.nan, 4.0), 10, 10) == pytest.approx(math.sqrt(12.5))
    assert agreement_rmse_mm((math.nan, math.nan, 2.0), 10, 10) == 2.0
    half = agreement_rmse_mm((3.0, 4.0, 5.0), 5, 10)
    assert half == pytest.approx(math.sqrt((50 / 3 + 250**2) / 2))


def test_the_time_to_agree_ends_with_the_last_hurdle():
    heights = np.full(100, 0.15)
    heights[30:50], heights[60:80] = 0.19, 0.11
    first, second = Hurdle(0.19, 20, 90), Hurdle(0.11, 25, 90)
    # A stay of which one frame is 40 mm away is within 10 mm on root mean square.
    assert agreement_ms((first, second), heights, heights) == pytest.approx(590.0)
    assert agreement_ms((first, Hurdle(0.3, 25, 90)), heights, heights) == pytest.approx(700.0)
    assert math.isnan(agreement_ms((None, None), heights, heights))


def test_who_pushes_in_the_direction_of_motion_before_crossing_leads():
    own = np.linspace(0.15, 0.2, 100)
    push, none = np.full(100, 0.02), np.zeros(100)
    hurdle = Hurdle(0.18, 20, 90)
    assert leading_mw(hurdle, own, push, none) == pytest.approx(20.0)
    assert leading_mw(hurdle, own, none, push) == pytest.approx(-20.0)
    assert math.isnan(leading_mw(Hurdle(0.25, 20, 90), own, push, none))


def mean(policy, subject, behaviours=BOTH):
    return np.mean([lifted(each, subject, policy).scores["rmse_mm"] for each in behaviours])


def test_the_eager_need_a_follower_and_the_timid_a_leader():
    assert mean("agree_follower", "S1") < 0.6 * mean("agree_leader", "S1")
    assert mean("agree_leader", "S4") < 0.8 * mean("agree_follower", "S4")


def test_a_level_table_misses_the_robot_s_hurdle_and_an_oracle_does_not():
    level = lifted("other_hurdle", policy="anticipate").scores
    with contextlib.closing(Lift(make_scenario("other_hurdle", task="agree"))) as lift:
        oracle = foreknow_agreement(lift, SEED).scores
    assert level["robot_hurdle_mm"] > 20.0
    assert oracle["robot_hurdle_mm"] < 5.0
    assert level["rmse_mm"] > 3 * oracle["rmse_mm"]


def test_standing_still_does_not_pay():
    assert lifted("abreast", policy="hold").scores["rmse_mm"] > 50.0


def test_two_people_who_know_less_of_each_other_lead_more_to_their_own_hurdles(monkeypatch):
    """The direction that Chackochan and Sanguineti (2019) report."""
    monkeypatch.setattr(published, "CROSSING_SEEDS", 3)
    suite = make_suite("agree-v1")
    few = dataclasses.replace(suite, scenarios=suite.scenarios[:1], seeds=(0,))
    run = dataclasses.replace(human_human_run(few), suite=suite)
    assert published.roles_mw(run)(set()) > 0.0


def test_a_lift_is_proved_by_its_actions():
    episode = lifted("behind", policy=None)
    assert episode.failure is None
    scenario = make_scenario("behind", "S1", "human", task="agree")
    with contextlib.closing(Lift(scenario)) as lift:
        again = replay(lift, SEED, episode.trace.human_action, episode.trace.action, None)
    assert again.trace.digest() == episode.trace.digest()
    assert np.array_equal(again.scripted, episode.trace.human_action)


FRESH = """
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.execution.playing import play
from colift.benchmark.suites.catalogue import make_scenario
scenario = make_scenario("ahead", "S2", task="agree")
(episode,) = play(PolicySpec(text="agree_game"), scenario, (100000,))
print(episode.trace.digest())
"""


def test_a_fresh_process_has_the_same_bits():
    done = subprocess.run([sys.executable, "-c", FRESH], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == lifted("ahead", "S2").trace.digest()


def test_any_behaviour_plays_as_a_level_lift():
    episode = lifted("smooth", policy="agree_game")
    assert episode.failure is None
    assert episode.scores["rmse_mm"] == pytest.approx(episode.scores["tilt_mm"])
    assert math.isnan(episode.scores["robot_hurdle_mm"])


@pytest.mark.parametrize("uncertainty", [-0.1, 2.0, math.nan])
def test_the_uncertainty_must_be_a_speed_in_range(uncertainty):
    with pytest.raises(InputError, match="uncertainty"):
        Agree(uncertainty=uncertainty)
