import math

import numpy as np
import pytest
from colift.agents.estimators.gain_control import gain_control


def test_by_hand():
    assert gain_control(0.25, 0.04, -0.02) == pytest.approx(0.25 * 0.04 - 0.75 * 0.02)


def test_ends_are_the_leader_and_the_follower():
    assert gain_control(1.0, 0.013, -0.02) == 0.013
    assert gain_control(0.0, 0.013, -0.02) == -0.02


def test_linear_in_the_confidence_and_in_the_actions():
    confidences = np.linspace(0.0, 1.0, 11)
    actions = [gain_control(confidence, 0.03, -0.02) for confidence in confidences]
    assert np.diff(actions) == pytest.approx(np.full(10, 0.005), abs=1e-15)
    together = gain_control(0.3, 0.01 + 0.02, -0.04 + 0.02)
    apart = gain_control(0.3, 0.01, -0.04) + gain_control(0.3, 0.02, 0.02)
    assert together == pytest.approx(apart, abs=1e-15)


def test_equal_actions_need_no_arbiter():
    assert [gain_control(c, 0.02, 0.02) for c in (0.0, 0.37, 1.0)] == pytest.approx([0.02] * 3)


@pytest.mark.parametrize("confidence", [-1e-9, 1 + 1e-9, math.nan, math.inf])
def test_a_confidence_outside_its_range_is_refused(confidence):
    with pytest.raises(ValueError, match=r"confidence must be in \[0, 1\]"):
        gain_control(confidence, 0.0, 0.0)
