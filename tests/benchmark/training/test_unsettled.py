"""People whose hands are not still until a lift, nor back where it began."""

import numpy as np
import pytest
from colift.agents.agent import FRAME
from colift.agents.humans import GOAL_RANGE, SUBJECTS
from colift.benchmark.training.unsettled import Unsettled
from colift.robots.nao.kinematics import STROKE

SEEDS = range(100_000, 100_060)
NONE = {"waits": 0.0, "counters": 0.0, "halts": 0.0, "holds": 0.0, "shifts": 0.0}


def plans(**habits):
    behaviour = Unsettled(**(NONE | habits))
    return [behaviour.plan(SUBJECTS["S1"], seed) for seed in SEEDS]


@pytest.fixture(scope="module")
def mixed():
    return [Unsettled().plan(SUBJECTS["S1"], seed) for seed in SEEDS]


def test_it_begins_and_ends_at_rest_and_stays_in_reach_of_the_robot(mixed):
    for plan in mixed:
        target = plan.target
        assert target[0] == 0.0
        assert target[-1] == pytest.approx(0.0, abs=1e-12)
        assert STROKE[0] <= target.min()
        assert target.max() <= GOAL_RANGE[1] + 1e-9 < STROKE[1]


def test_it_moves_without_jumps_and_at_a_persons_speed(mixed):
    for plan in mixed:
        speed = np.diff(plan.target) / FRAME
        assert np.abs(speed).max() < 0.8
        assert np.abs(np.diff(speed)).max() / FRAME < 12.0


def test_its_strokes_last_a_second_to_four():
    lasting = [FRAME * (plan.strokes[0][1] - plan.strokes[0][0]) for plan in plans()]
    assert min(lasting) < 1.3
    assert max(lasting) > 3.0


def test_some_wait_for_six_seconds():
    resting = [FRAME * plan.strokes[0][0] for plan in plans(waits=1.0)]
    assert min(resting) < 1.5
    assert 5.0 < max(resting) < 8.0


def test_some_go_down_before_the_lift_or_up_and_back():
    def before(plan):
        return plan.target[: int(np.argmax(plan.target > 0.05))]

    dips = [before(plan).min() for plan in plans(counters=1.0, false_starts=0.0)]
    assert -0.03 <= min(dips) < -0.025
    assert max(dips) < -0.002
    for plan in plans(counters=1.0, false_starts=1.0):
        assert (np.diff(before(plan)) < -1e-6).any()
        assert plan.target.min() > -1e-12


def test_some_halt_on_the_way():
    plain, halting = (sum(len(plan.target) for plan in plans(halts=share)) for share in (0.0, 1.0))
    assert halting > plain + 2 * len(SEEDS) * 5


def test_some_come_to_rest_above_or_below_the_start_and_move_on():
    def levels(plan):
        lowered = int(np.flatnonzero(plan.target > 0.05)[-1])
        still = np.abs(np.diff(plan.target[lowered:])) < 1e-9
        return {round(1000 * level, 2) for level in plan.target[lowered + 1 :][still]} - {0.0, -0.0}

    ends = [levels(plan) for plan in plans(shifts=1.0, recoils=0.0)]
    assert all(len(each) == 1 for each in ends)
    found = [each.pop() for each in ends]
    assert -30.0 <= min(found) < -20.0
    assert 20.0 < max(found) <= 30.0
    assert any(len(levels(plan)) > 1 for plan in plans(shifts=1.0, recoils=1.0))


def test_a_seed_is_a_plan(mixed):
    again = Unsettled().plan(SUBJECTS["S1"], SEEDS[0])
    assert (again.target == mixed[0].target).all()
    assert len({len(plan.target) for plan in mixed}) > 40
