"""The task of the ball: its lifts, its scores, and how its policies and people fare."""

import contextlib
import subprocess
import sys

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.policies.copy import Copy
from colift.agents.tasks.ball.observation import BallObservation
from colift.agents.tasks.touch.observation import HapticObservation
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.replay import replay
from colift.benchmark.results.baselines import partner_spec
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.ball.oracle import foresee
from colift.benchmark.tasks.ball.scores import (
    ball_settling_ms,
    velocity_peaks,
    ways,
)
from colift.benchmark.tasks.ball.task import FELL, BallSteering
from colift.testing import check_suite, check_task

DIGEST = "d8910584b13585aa"
SEED = 100_000


def lifted(behaviour, subject="S1", policy="ball_game", seed=SEED):
    """Return a lift with a policy, or with a second person."""
    partner = "human" if policy is None else "nao"
    scenario = make_scenario(behaviour, subject, partner, task="ball")
    agent = partner_spec(scenario) if policy is None else PolicySpec(text=policy)
    with contextlib.closing(Lift(scenario)) as lift, agent.agent() as holder:
        return run_episode(lift, holder, seed)


def test_the_suite_is_what_it_was():
    """A change here is a new suite: bundles of the old one no longer belong to it."""
    assert make_suite("ball-v1").digest == DIGEST


def test_task_and_suite_conform():
    check_task(BallSteering(), "ball_smooth")
    check_task(BallSteering())
    check_suite(make_suite("ball-v1"))


def test_the_first_seven_numbers_are_those_of_touch():
    names = [each.name for each in BallObservation]
    assert names[: len(HapticObservation)] == [each.name for each in HapticObservation]


def test_a_target_known_to_both_is_observed_and_a_private_one_is_not():
    for behaviour, known in (("ball_smooth", 0.0), ("ball_smooth_shared", 1.0)):
        scenario = make_scenario(behaviour, "S2", task="ball")
        with contextlib.closing(Lift(scenario)) as lift:
            lift.reset(SEED)
            while abs(lift.due.place[lift.frame]) < 0.05:
                lift.step(np.zeros(10), np.zeros(1))
            seen = lift.partner_observation()
        assert seen[BallObservation.TARGET_KNOWN] == known
        assert (seen[BallObservation.TARGET_PLACE] != 0.0) == bool(known)


def test_lost_frames_count_as_such():
    task = BallSteering()
    scenario = make_scenario("ball_smooth", "S1", task="ball")
    with contextlib.closing(Lift(scenario)) as lift:
        lift.reset(SEED)
        trace = run_episode(lift, Copy(), SEED).trace
        horizon, half = lift.horizon, lift.horizon // 2
        for frames, expected in ((horizon, 900.0), (half, (900 + 250**2) / 2), (0, 250.0**2)):
            cut, ball = trace.until(frames // 10), lift.due.place[:frames] + 0.03
            found = task.rmse_mm(lift, cut, ball)
            share = frames / horizon
            assert found**2 == pytest.approx(share * 900 + (1 - share) * 250**2)
            assert frames == 0 or found**2 == pytest.approx(expected, rel=0.02)


def moved(*stops):
    """Return a target that goes to each place in 50 frames, and stays for 150."""
    path, here = [np.zeros(100)], 0.0
    for there in stops:
        path += [np.linspace(here, there, 51)[1:], np.full(150, there)]
        here = there
    return np.concatenate(path)


def test_each_way_of_the_target_is_a_window():
    assert [(each.start, each.stop) for each in ways(moved(0.1, -0.1))] == [(100, 300), (300, 500)]
    assert list(ways(np.zeros(50))) == []


def test_settling_counts_from_the_targets_first_movement():
    target, missed = moved(0.1, -0.1), np.zeros(500)
    missed[120:180] = 0.03
    assert ball_settling_ms(missed, target) == pytest.approx((800 + 0) / 2)
    assert np.isnan(ball_settling_ms(missed[:50], target[:50]))


def test_one_push_and_brake_is_one_peak():
    target = moved(0.1)
    t = np.clip((np.arange(300) - 100) / 100, 0.0, 1.0)
    straight = 0.1 * t**3 * (10 - 15 * t + 6 * t**2)
    number, size = velocity_peaks(straight, target)
    assert number == 1
    assert size == pytest.approx(1.875 * 0.1, rel=0.01)
    ringing = straight + 0.02 * np.sin(2 * np.pi * t * 3)
    assert velocity_peaks(ringing, target)[0] > 2
    assert velocity_peaks(np.zeros(300), target)[0] == 0


@pytest.mark.slow
def test_a_level_table_is_not_enough_and_an_oracle_nearly_perfect():
    level = lifted("ball_smooth", policy="anticipate").scores["rmse_mm"]
    with contextlib.closing(Lift(make_scenario("ball_smooth", "S1", task="ball"))) as lift:
        oracle = foresee(lift, SEED).scores["rmse_mm"]
    assert level > 60.0
    assert oracle < 15.0


def test_a_robot_that_stands_still_loses_the_ball():
    episode = lifted("ball_smooth", policy="hold")
    assert episode.failure == FELL
    assert episode.scores["fallen"] == 1.0
    assert episode.scores["rmse_mm"] > 150.0


def test_admittance_suits_people_who_show_half_and_not_those_who_show_all():
    half, much = (
        lifted("ball_smooth_shared", person, "ball_admittance").scores["rmse_mm"]
        for person in ("S1", "S4")
    )
    assert much > 3 * half


def test_two_people_steer_and_the_lift_is_proved_by_its_actions():
    episode = lifted("ball_smooth", policy=None)
    assert episode.failure is None
    assert episode.scores["rmse_mm"] < 100.0
    scenario = make_scenario("ball_smooth", "S1", "human", task="ball")
    with contextlib.closing(Lift(scenario)) as lift:
        again = replay(lift, SEED, episode.trace.human_action, episode.trace.action, None)
    assert again.trace.digest() == episode.trace.digest()


FRESH = """
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.execution.playing import play
from colift.benchmark.suites.catalogue import make_scenario
scenario = make_scenario("ball_pause", "S2", task="ball")
(episode,) = play(PolicySpec(text="ball_game"), scenario, (100000,))
print(episode.trace.digest())
"""


def test_a_fresh_process_has_the_same_bits():
    done = subprocess.run([sys.executable, "-c", FRESH], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == lifted("ball_pause", "S2").trace.digest()
