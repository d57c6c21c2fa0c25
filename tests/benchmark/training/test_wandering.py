"""People with wide habits: within the stroke, smooth, and different from lift to lift."""

import numpy as np
import pytest
from colift.agents.humans import GOAL_RANGE, SUBJECTS
from colift.benchmark.training.wandering import LONGEST, LOWEST, Wandering

PLANS = {seed: Wandering().plan(SUBJECTS["S1"], seed) for seed in range(12)}


@pytest.mark.parametrize("seed", PLANS)
def test_a_plan_is_within_the_stroke_and_smooth(seed):
    target = PLANS[seed].target
    assert target[0] == pytest.approx(0.0, abs=1e-3)
    assert target[-1] == pytest.approx(0.0, abs=1e-3)
    assert target.min() >= LOWEST
    assert target.max() <= GOAL_RANGE[1]
    assert np.abs(np.diff(target)).max() < 0.015
    assert LONGEST / 2 < len(target) / 100 < 5 * LONGEST


def test_a_plan_follows_from_its_seed():
    again = Wandering().plan(SUBJECTS["S1"], 3)
    assert (again.target == PLANS[3].target).all()
    assert not np.array_equal(PLANS[3].target, PLANS[4].target)


def test_paces_and_sizes_are_wide():
    speeds = [100 * np.abs(np.diff(plan.target)).max() for plan in PLANS.values()]
    assert max(speeds) > 4 * min(speeds)
    heights = [plan.target.max() for plan in PLANS.values()]
    assert max(heights) > 2 * min(heights)
