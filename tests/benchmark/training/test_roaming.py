import numpy as np
import pytest
from colift.agents.agent import FRAME
from colift.agents.humans import GOAL_RANGE, SUBJECTS
from colift.benchmark.training.roaming import LOWEST, Roaming
from colift.robots.nao.kinematics import STROKE

PLANS = [Roaming().plan(SUBJECTS["S1"], seed) for seed in range(100_000, 100_030)]


def test_it_begins_and_ends_at_rest_and_stays_in_reach_of_the_robot():
    for plan in PLANS:
        target = plan.target
        assert target[0] == target[-1] == 0.0
        assert STROKE[0] < LOWEST <= target.min()
        assert target.max() <= GOAL_RANGE[1] + 1e-9 < STROKE[1]


def test_it_moves_without_jumps_and_at_a_persons_speed():
    for plan in PLANS:
        speed = np.abs(np.diff(plan.target)) / FRAME
        assert speed.max() < 0.8
        assert np.abs(np.diff(speed)).max() / FRAME < 12.0


def test_it_is_less_regular_than_a_lift():
    """It goes to several goals, up and down, some given up on the way."""
    ways = []
    for plan in PLANS:
        velocity = np.diff(plan.target)
        way = np.sign(velocity[np.abs(velocity) > 1e-5])
        ways.append(1 + np.count_nonzero(np.diff(way)))
    assert np.mean(ways) > 3
    assert len({len(plan.target) for plan in PLANS}) > 20


def test_a_seed_is_a_plan():
    again = Roaming().plan(SUBJECTS["S3"], 100_000)
    assert again.target == pytest.approx(PLANS[0].target)
