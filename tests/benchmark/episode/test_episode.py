"""One episode: scores, failures, determinism."""

import contextlib
import math

import numpy as np
import pytest
from colift.agents.humans import SecondPerson
from colift.agents.policies.copy import Copy
from colift.agents.policies.hold import Hold
from colift.benchmark.bundle.table import table_row
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.metrics import FAILED_FRAME_MM
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tasks.level.task import LEVEL


class Scripted(Hold):
    """Holds for some steps, then does what it is told."""

    def __init__(self, then, after=5):
        self.then, self.left = then, after

    def act(self, observation):
        self.left -= 1
        return self.then() if self.left < 0 else np.zeros(1)


def fail():
    raise ZeroDivisionError("oh no")


@pytest.fixture(scope="module")
def lift():
    made = Lift(make_scenario("pause", "S2"))
    yield made
    made.close()


def test_an_episode_has_all_frames_and_all_scores(lift):
    episode = run_episode(lift, Copy(), 4)
    assert episode.failure is None
    assert len(episode.trace.human_end) == lift.horizon
    assert len(episode.trace.action) == len(episode.step_times) == lift.horizon // 10
    row = table_row(episode, LEVEL.metrics)
    assert (row["behaviour"], row["subject"], row["seed"]) == ("pause", "S2", 4)
    gap = 1000 * (episode.trace.human_end - episode.trace.robot_end)
    assert row["rmse_mm"] == pytest.approx(math.sqrt(np.mean(gap**2)))
    assert all(math.isfinite(row[name]) for name in ("sparc", "ldlj", "robot_lag_ms"))


@pytest.mark.parametrize(
    ("then", "told"),
    [
        (fail, "step 5: ZeroDivisionError: oh no"),
        (lambda: np.array([math.nan]), "step 5: robot's action must be finite"),
        (lambda: np.zeros(3), "step 5: robot's action must be 1 number"),
        (lambda: None, "step 5: robot's action must be 1 number"),
        (lambda: "up", "step 5: robot's action must be 1 number"),
    ],
)
def test_a_failing_policy_ends_the_episode_with_the_reason_and_counts_as_worst(lift, then, told):
    episode = run_episode(lift, Scripted(then), 4)
    assert episode.failure.startswith(told)
    assert len(episode.trace.human_end) == 50
    whole = run_episode(lift, Hold(), 4)
    assert episode.scores["rmse_mm"] > whole.scores["rmse_mm"]
    missing = (lift.horizon - 50) / lift.horizon
    assert episode.scores["rmse_mm"] == pytest.approx(
        FAILED_FRAME_MM * math.sqrt(missing), rel=0.01
    )
    assert math.isnan(episode.scores["sparc"])
    assert math.isnan(episode.scores["ldlj"])


def test_a_policy_that_fails_at_once_scores_the_worst_there_is(lift):
    class Broken(Hold):
        def reset(self, seed):
            raise RuntimeError("no model file")

    episode = run_episode(lift, Broken(), 4)
    assert episode.failure == "start: RuntimeError: no model file"
    assert episode.scores["rmse_mm"] == FAILED_FRAME_MM
    assert len(episode.trace.human_end) == 0


def test_the_same_seed_gives_the_same_bits_alone_and_after_many_others(lift):
    fresh = Lift(make_scenario("pause", "S2"))
    alone = run_episode(fresh, Copy(), 11).trace.digest()
    fresh.close()
    for seed in range(100, 125):
        run_episode(lift, Copy() if seed % 2 else Hold(), seed)
    assert run_episode(lift, Copy(), 11).trace.digest() == alone


def test_another_seed_subject_or_behaviour_gives_another_plan():
    plans = set()
    for behaviour, subject, seed in [
        ("smooth", "S1", 0),
        ("smooth", "S1", 1),
        ("smooth", "S2", 0),
        ("jerky", "S1", 0),
    ]:
        made = Lift(make_scenario(behaviour, subject))
        made.reset(seed)
        plans.add(made.plan.target.tobytes())
        made.close()
    assert len(plans) == 4


def test_a_digest_sees_one_changed_bit(lift):
    episode = run_episode(lift, Copy(), 4)
    before = episode.trace.digest()
    episode.trace.action[3, 0] = np.nextafter(episode.trace.action[3, 0], 1.0)
    assert episode.trace.digest() != before


def test_the_share_of_actions_that_were_cut_is_told(lift):
    far = 1.01 * lift.step_limit
    cut = run_episode(lift, Scripted(lambda: [far]), 4)
    steps = len(cut.trace.action)
    assert steps > 5
    assert cut.scores["clipped"] == pytest.approx(1 - 5 / steps)
    assert run_episode(lift, Scripted(lambda: [-lift.step_limit]), 4).scores["clipped"] == 0.0


def test_a_policy_without_an_action_and_a_second_human_have_no_share(lift):
    assert math.isnan(run_episode(lift, Scripted(fail, after=0), 4).scores["clipped"])
    with contextlib.closing(Lift(make_scenario("smooth", partner="human"))) as human_human:
        assert math.isnan(run_episode(human_human, SecondPerson(), 4).scores["clipped"])
