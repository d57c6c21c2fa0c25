"""Whether the benchmark measures what it is meant to: facts that must hold for every behaviour."""

import math

import numpy as np
import pytest
from colift.agents.agent import RobotObservation
from colift.agents.policies.copy import Copy
from colift.agents.policies.hold import Hold
from colift.agents.policies.random import Random
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.metric import reached
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.episode.turns import policy_seed
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tasks.level.task import LEVEL

BEHAVIOURS = ["smooth", "pause", "jerky", "changing_goal"]
SEEDS = range(6)


class Shaky(Copy):
    """Copies, and shakes the table by a centimetre at 5 Hz."""

    def reset(self, seed):
        self.sign = 1.0

    def act(self, observation):
        self.sign = -self.sign
        return super().act(observation) + 0.01 * self.sign


class Late(Copy):
    """Copies what it saw half a second ago."""

    def reset(self, seed):
        self.seen = []

    def act(self, observation):
        self.seen.append(observation.copy())
        old = self.seen[max(0, len(self.seen) - 6)]
        view = observation.copy()
        view[RobotObservation.HUMAN_END] = old[RobotObservation.HUMAN_END]
        return super().act(view)


def play(behaviour, policy, subject="S5"):
    lift = Lift(make_scenario(behaviour, subject))
    episodes = [run_episode(lift, policy(), seed) for seed in SEEDS]
    lift.close()
    return episodes


def mean(episodes, name):
    return np.mean([episode.scores[name] for episode in episodes])


@pytest.fixture(scope="module")
def played():
    policies = (Copy, Hold, Random)
    return {(b, p): play(b, p) for b in BEHAVIOURS for p in policies}


@pytest.mark.parametrize("behaviour", BEHAVIOURS)
class TestPolicies:
    @pytest.mark.parametrize("policy", [Hold, Random])
    def test_doing_nothing_or_anything_loses_clearly_in_every_episode(
        self, played, behaviour, policy
    ):
        pairs = zip(played[behaviour, Copy], played[behaviour, policy], strict=True)
        for copied, other in pairs:
            assert other.scores["rmse_mm"] > 1.5 * copied.scores["rmse_mm"]
        both = mean(played[behaviour, policy], "rmse_mm"), mean(played[behaviour, Copy], "rmse_mm")
        assert both[0] > 3 * both[1]

    def test_no_episode_is_level_by_standing_still(self, played, behaviour):
        for episode in played[behaviour, Hold]:
            assert episode.scores["rmse_mm"] > 40
            assert episode.scores["max_tilt_deg"] > 5

    def test_holding_still_earns_no_smoothness(self, played, behaviour):
        for episode in played[behaviour, Hold]:
            assert math.isnan(episode.scores["sparc"])
            assert math.isnan(episode.scores["ldlj"])

    def test_the_human_reaches_the_goal_or_the_episode_says_that_it_did_not(
        self, played, behaviour
    ):
        for policy in (Hold, Copy):
            for episode in played[behaviour, policy]:
                top = 1000 * (episode.trace.target.max() - episode.trace.human_end.max())
                assert episode.scores["short_of_goal_mm"] == pytest.approx(top, abs=1e-6)
                assert reached(episode.scores, LEVEL.metrics) == (top <= 20)
        assert all(reached(episode.scores, LEVEL.metrics) for episode in played[behaviour, Copy])

    def test_every_policy_meets_the_same_plan(self, played, behaviour):
        pairs = zip(played[behaviour, Copy], played[behaviour, Random], strict=True)
        for copied, other in pairs:
            assert copied.trace.target.tobytes() == other.trace.target.tobytes()

    def test_every_policy_meets_the_same_noise_of_human_and_sensors(self, behaviour):
        lift = Lift(make_scenario(behaviour, "S3"))
        noise = []
        for _ in range(2):
            lift.reset(5)
            view = lift.human_observation()
            noise.append((lift.partner_observation(), lift.scripted_human().act(view)))
        lift.close()
        assert noise[0][0].tobytes() == noise[1][0].tobytes()
        assert noise[0][1].tobytes() == noise[1][1].tobytes()


def test_a_jerky_robot_disturbs_the_human():
    calm, shaken = play("smooth", Copy), play("smooth", Shaky)
    assert mean(shaken, "human_force_n") > 1.2 * mean(calm, "human_force_n")

    def shaking_at_5_hz(episodes):
        paths = [np.gradient(episode.trace.human_end) for episode in episodes]
        waves = [np.exp(0.1j * np.pi * np.arange(len(path))) for path in paths]
        return np.mean([abs(p @ wave) / len(p) for p, wave in zip(paths, waves, strict=True)])

    assert shaking_at_5_hz(shaken) > 5 * shaking_at_5_hz(calm)


def test_a_lagging_robot_is_felt_at_the_hand_and_seen_in_the_lag():
    prompt, late = play("smooth", Copy), play("smooth", Late)
    assert mean(late, "human_force_n") > 1.5 * mean(prompt, "human_force_n")
    assert mean(late, "robot_lag_ms") - mean(prompt, "robot_lag_ms") == pytest.approx(500, abs=60)


class TestSecrecy:
    def test_a_policys_seed_is_the_same_whatever_the_episode(self):
        seen = set()

        class Curious(Hold):
            def reset(self, seed):
                seen.add(seed)

        for behaviour in BEHAVIOURS:
            play(behaviour, Curious)
        assert seen == {policy_seed()}

    def test_no_role_is_reset_with_a_seed_from_which_another_follows(self):
        roles = [f"{role}/pause/S1" for role in ("plan", "sensor", "human")]
        drawn = {derive_seed(seed, role) for seed in range(2000) for role in roles}
        assert len(drawn) == 6000
        assert policy_seed() not in drawn

    def test_a_random_policy_differs_from_episode_to_episode(self):
        actions = {episode.trace.action[:5].tobytes() for episode in play("smooth", Random)}
        assert len(actions) == len(SEEDS)

    def test_before_the_human_moves_an_observation_tells_nothing_of_the_plan(self):
        """Rest and noise only: no correlation with the goal that is about to come."""
        lift = Lift(make_scenario("smooth", "S2"))
        goals, views = [], []
        for seed in range(300):
            lift.reset(seed)
            goals.append(lift.plan.goal)
            views.append(lift.partner_observation())
        lift.close()
        views = np.array(views)
        assert (views[:, RobotObservation.TIME] == 0).all()
        for column in (RobotObservation.HUMAN_END, RobotObservation.ROBOT_END):
            assert abs(np.corrcoef(views[:, column], goals)[0, 1]) < 0.2
