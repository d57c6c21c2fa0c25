"""The task of intended poses: its lifts, its scores, and how its policies and people fare."""

import contextlib
import subprocess
import sys

import numpy as np
import pytest
from colift.agents.agent import RobotObservation
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.tasks.touch.observation import HapticObservation
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.replay import replay
from colift.benchmark.results.baselines import partner_spec
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.intent.manner import MANNERS
from colift.benchmark.tasks.intent.oracle import foreknow_pose
from colift.benchmark.tasks.intent.scores import peak_mm, pose_rmse_mm, settling_ms

DIGEST = "a0aeec6659923fee"
SEED = 100_000


def lifted(behaviour, subject="S1", policy="pose_bayes", seed=SEED):
    """Return a lift with a policy, or with a second person."""
    partner = "human" if policy is None else "nao"
    scenario = make_scenario(behaviour, subject, partner, task="intent")
    agent = partner_spec(scenario) if policy is None else PolicySpec(text=policy)
    with contextlib.closing(Lift(scenario)) as lift, agent.agent() as holder:
        return run_episode(lift, holder, seed)


def test_the_suite_is_what_it_was():
    """A change here is a new suite: bundles of the old one no longer belong to it."""
    assert make_suite("intent-v1").digest == DIGEST


def test_the_first_five_numbers_are_those_of_version_1():
    names = [each.name for each in HapticObservation]
    assert names[: len(RobotObservation)] == [each.name for each in RobotObservation]


def test_rmse_is_over_both_ends_and_failed_frames_count():
    near, far = np.full(50, 0.003), np.full(50, -0.004)
    assert pose_rmse_mm((near, far), 50) == pytest.approx(np.sqrt((9 + 16) / 2))
    assert pose_rmse_mm((near, far), 100) == pytest.approx(np.sqrt((12.5 + 250**2) / 2))
    assert pose_rmse_mm((near[:0], far[:0]), 10) == 250.0


def test_settling_counts_from_the_beginning_to_the_last_frame_outside():
    missed = np.zeros(200)
    missed[20:55] = 0.02
    assert settling_ms(missed, [(20, 100)]) == 350.0
    assert settling_ms(missed, [(120, 180)]) == 0.0
    assert np.isnan(settling_ms(missed, []))
    assert peak_mm(missed, [(0, 30), (100, 130)]) == pytest.approx(10.0)


@pytest.mark.slow
@pytest.mark.parametrize("behaviour", ["pivot", "counter"])
def test_a_level_table_is_wrong_and_an_oracle_nearly_perfect(behaviour):
    level = lifted(behaviour, policy="anticipate").scores["rmse_mm"]
    with contextlib.closing(Lift(make_scenario(behaviour, "S1", task="intent"))) as lift:
        oracle = foreknow_pose(lift, SEED).scores["rmse_mm"]
    assert oracle < 3.0
    assert level > 10 * oracle


def test_yielding_suits_people_with_strong_wrists_alone():
    strong, weak = (
        lifted("counter", person, "pose_admittance").scores["rmse_mm"] for person in ("S1", "S4")
    )
    assert strong < 12.0
    assert weak > 3 * strong


def test_a_person_who_is_not_followed_does_not_go_on():
    episode = lifted("together", policy="hold")
    assert episode.trace.human_end.max() < 2 * MANNERS["S1"].patience + 0.005
    assert episode.trace.target.max() > 3 * MANNERS["S1"].patience


def test_two_people_find_the_pose_and_the_lift_is_proved_by_its_actions():
    episode = lifted("counter", policy=None)
    assert episode.failure is None
    assert episode.scores["rmse_mm"] < lifted("counter", policy="touch_level").scores["rmse_mm"]
    scenario = make_scenario("counter", "S1", "human", task="intent")
    with contextlib.closing(Lift(scenario)) as lift:
        again = replay(lift, SEED, episode.trace.human_action, episode.trace.action, None)
    assert again.trace.digest() == episode.trace.digest()
    assert np.array_equal(again.scripted, episode.trace.human_action)


FRESH = """
from colift.benchmark.tasks.intent.manner import MANNERS
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.execution.playing import play
from colift.benchmark.suites.catalogue import make_scenario
scenario = make_scenario("switching", "S2", task="intent")
(episode,) = play(PolicySpec(text="pose_bayes"), scenario, (100000,))
print(episode.trace.digest())
"""


def test_a_fresh_process_has_the_same_bits():
    done = subprocess.run([sys.executable, "-c", FRESH], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == lifted("switching", "S2").trace.digest()


def test_any_behaviour_plays_as_a_level_lift():
    episode = lifted("smooth", policy="touch_level")
    assert episode.failure is None
    assert episode.scores["rmse_mm"] < 8.0
