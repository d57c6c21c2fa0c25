"""What holds for the plans of every behaviour."""

import numpy as np
import pytest
from colift.agents.agent import FRAME
from colift.agents.estimators.minimum_jerk import profile
from colift.agents.humans import (
    GOAL_RANGE,
    SUBJECTS,
    ChangingGoal,
    Jerky,
    Pause,
    Recorded,
    Recording,
    Smooth,
    Subject,
)
from colift.testing import check_behaviour

S2 = SUBJECTS["S2"]


def recording():
    t = np.arange(0.0, 4.0, 0.02)
    z = 0.7 * (profile(t / 1.5) - profile((t - 2.2) / 1.5))
    return Recording(name="one", times=tuple(t.tolist()), heights=tuple(z.tolist()))


BEHAVIOURS = [Smooth(), Pause(), Jerky(), ChangingGoal(), Recorded(recording=recording())]
every_behaviour = pytest.mark.parametrize("behaviour", BEHAVIOURS, ids=lambda b: type(b).__name__)


def derivatives(plan):
    velocity = np.diff(plan.target) / FRAME
    return velocity, np.diff(velocity) / FRAME


@pytest.mark.slow
@every_behaviour
def test_goals_fit_the_arm_for_everyone(behaviour):
    names = list(SUBJECTS.values())
    lowest = -0.03 if isinstance(behaviour, Recorded) else -1e-9
    for seed in range(500):
        subject = Subject.draw(seed) if seed % 3 == 0 else names[seed % 5]
        plan = behaviour.plan(subject, seed)
        assert GOAL_RANGE[0] <= plan.goal <= GOAL_RANGE[1]
        assert plan.goal == plan.target.max()
        assert plan.target.min() >= lowest


@every_behaviour
def test_plans_have_no_steps_in_position_velocity_or_acceleration(behaviour):
    jerk_limit = 120.0 if isinstance(behaviour, Jerky) else 30.0
    for seed in range(60):
        velocity, acceleration = derivatives(behaviour.plan(S2, seed))
        assert np.abs(velocity).max() < 0.5
        assert (
            np.abs(np.diff(velocity)).max() < (4.5 if isinstance(behaviour, Jerky) else 2) * FRAME
        )
        assert np.abs(np.diff(acceleration)).max() < jerk_limit * FRAME


@every_behaviour
def test_plans_begin_and_end_at_rest_at_zero(behaviour):
    for seed in range(20):
        plan = behaviour.plan(S2, seed)
        assert len(plan.target) % 10 == 0
        first, last = plan.strokes[0][0], plan.strokes[-1][1]
        assert 60 <= first <= 210
        assert np.abs(plan.target[:60]).max() < 1e-12
        assert np.abs(plan.target[-60:]).max() < 1e-12
        assert last <= len(plan.target) - 60


@every_behaviour
def test_events_are_in_order_and_inside_the_plan(behaviour):
    plan = behaviour.plan(S2, 3)
    frames = [frame for _, frame in plan.events]
    assert frames == sorted(frames)
    assert frames[0] == 0
    assert frames[-1] < len(plan.target)


@every_behaviour
def test_time_gives_nothing_away(behaviour):
    plans = [behaviour.plan(S2, seed) for seed in range(100)]
    assert np.ptp([plan.strokes[0][0] for plan in plans]) > 80
    assert np.ptp([len(plan.target) for plan in plans]) >= 100


@every_behaviour
def test_every_behaviour_conforms(behaviour):
    check_behaviour(behaviour)
