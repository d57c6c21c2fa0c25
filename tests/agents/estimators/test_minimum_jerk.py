"""The minimum-jerk stroke against calculus."""

import numpy as np
import pytest
from colift.agents.estimators.minimum_jerk import (
    MinimumJerkStroke,
    profile,
    profile_curvature,
    profile_rate,
)
from numpy.polynomial import Polynomial

PROFILE = Polynomial([0, 0, 0, 10, -15, 6])
STROKE = MinimumJerkStroke(start=0.04, end=0.23, onset=0.63, duration=1.7)
WIDTH = 1e-6


@pytest.mark.parametrize(("function", "order"), [(profile, 0), (profile_rate, 1)])
def test_the_course_and_its_derivatives(function, order):
    tau = np.linspace(0, 1, 41)
    assert function(tau) == pytest.approx(PROFILE.deriv(order)(tau) if order else PROFILE(tau))
    assert profile_curvature(tau) == pytest.approx(PROFILE.deriv(2)(tau), abs=1e-12)


def test_before_and_after_it_rests():
    assert profile([-3.0, 0.0, 1.0, np.inf]).tolist() == [0, 0, 1, 1]
    assert profile_rate([-3.0, 0.0, 1.0, 5.0]).tolist() == [0, 0, 0, 0]
    assert STROKE.height(np.array([0.0, 0.63, 2.33, 9.0])) == pytest.approx(
        [0.04, 0.04, 0.23, 0.23]
    )


def test_no_other_smooth_movement_has_less_jerk():
    """Any variation that leaves both ends at rest adds to the integral of squared jerk."""
    bump = Polynomial([0, 0, 0, 1, -3, 3, -1])
    jerks = [
        ((PROFILE + share * bump).deriv(3) ** 2).integ()(1.0) for share in (-0.3, -0.1, 0, 0.1, 0.3)
    ]
    assert min(jerks) == jerks[2] == pytest.approx(720.0)


def test_velocity_and_acceleration_are_derivatives():
    time = np.linspace(0.3, 2.6, 47)
    ahead, behind = time + WIDTH, time - WIDTH
    slope = (STROKE.height(ahead) - STROKE.height(behind)) / (2 * WIDTH)
    assert STROKE.velocity(time) == pytest.approx(slope, abs=1e-8)
    slope = (STROKE.velocity(ahead) - STROKE.velocity(behind)) / (2 * WIDTH)
    assert STROKE.acceleration(time) == pytest.approx(slope, abs=1e-6)


@pytest.mark.parametrize("time", [0.2, 0.7, 1.1, 1.9, 2.32, 3.0])
def test_the_gradient_by_finite_differences(time):
    values = np.array([STROKE.start, STROKE.end, STROKE.onset, STROKE.duration])

    def height(values):
        start, end, onset, duration = values
        stroke = MinimumJerkStroke(start=start, end=end, onset=onset, duration=duration)
        return stroke.height(time)

    slopes = [
        (height(values + step) - height(values - step)) / (2 * WIDTH) for step in WIDTH * np.eye(4)
    ]
    assert STROKE.gradient(time) == pytest.approx(slopes, abs=1e-8)
    assert STROKE.gradient(np.full(3, time)).shape == (4, 3)
