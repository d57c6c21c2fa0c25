"""The process against the minimum-jerk movement, calculus and simulation."""

import math

import numpy as np
import pytest
from colift.agents.estimators.minimum_jerk import MinimumJerkStroke
from colift.agents.estimators.minimum_jerk_process import (
    MinimumJerkProcess,
    minimum_jerk_transition,
)
from colift.base.errors import InputError

STROKE = MinimumJerkStroke(start=0.04, end=0.23, onset=0.0, duration=2.0)
SHARP = MinimumJerkProcess(shortest=0.1, softness=0.001)
"""Its time to go is the clock itself from 0.11 s on."""


def on_the_way(time):
    """Return the state of the stroke at a time, with the jerk of its polynomial."""
    tau = time / 2.0
    jerk = 0.19 / 8.0 * (60 - 360 * tau + 360 * tau**2)
    rates = [STROKE.height(time), STROKE.velocity(time), STROKE.acceleration(time), jerk]
    return np.array([*rates, 2.0 - time])


@pytest.mark.parametrize("period", [0.02, 0.1, 0.3])
@pytest.mark.parametrize("time", [0.0, 0.2, 0.9, 1.5])
def test_a_minimum_jerk_stroke_goes_on_as_one(time, period):
    moved, _ = SHARP.advance(on_the_way(time), period)
    assert moved == pytest.approx(on_the_way(time + period), abs=1e-9)
    assert SHARP.goal(on_the_way(time)) == pytest.approx(0.23, abs=1e-9)


def test_any_movement_ends_at_rest_at_its_goal():
    state = np.array([0.1, -0.2, 0.7, -3.0, 1.3])
    moved, _ = SHARP.advance(state, 1.3)
    assert moved[:3] == pytest.approx([SHARP.goal(state), 0.0, 0.0], abs=1e-9)
    beyond, _ = SHARP.advance(state, 9.0)
    assert beyond[:3] == pytest.approx(moved[:3])


@pytest.mark.parametrize("to_go", [0.5, 1.3])
def test_two_short_steps_are_a_long_one(to_go):
    there = minimum_jerk_transition(0.25, to_go - 0.2) @ minimum_jerk_transition(0.2, to_go)
    assert there == pytest.approx(minimum_jerk_transition(0.45, to_go), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("clock", [-3.0, 0.0, 0.6, 0.9, 1.6])
@pytest.mark.parametrize("period", [0.02, 0.1, 0.22])
def test_the_jacobian_by_finite_differences(clock, period):
    process, width = MinimumJerkProcess(), 1e-6
    state = np.array([0.1, 0.15, -0.3, 2.0, clock])
    columns = [
        (process.advance(state + step, period)[0] - process.advance(state - step, period)[0])
        / (2 * width)
        for step in width * np.eye(5)
    ]
    jacobian = process.advance(state, period)[1]
    assert jacobian == pytest.approx(np.transpose(columns), abs=1e-7)
    assert clock < 0 or np.abs(jacobian[:4, 4]).max() > 1e-4


def test_the_time_to_go_bends_from_the_clock_to_the_shortest():
    process = MinimumJerkProcess(shortest=0.8, softness=0.2)
    assert process.time_to_go(3.0) == pytest.approx((3.0, 1.0), abs=1e-4)
    assert process.time_to_go(-50.0) == pytest.approx((0.8, 0.0), abs=1e-9)
    assert process.time_to_go(0.8) == pytest.approx((0.8 + 0.2 * math.log(2), 0.5))


def test_the_noise_is_that_of_a_constant_snap():
    """Integrated by Euler steps from rest, with the standard deviation of one step's snap."""
    process, period, count = MinimumJerkProcess(jerk_noise=1.3, clock_noise=0.2), 0.1, 20_000
    state, dt = np.zeros(4), period / count
    snap = 1.3 / math.sqrt(period)
    for _ in range(count):
        state = state + dt * np.append(state[1:], snap)
    noise = process.noise(period)
    assert noise[:4, :4] == pytest.approx(np.outer(state, state), rel=1e-3)
    assert noise[4].tolist() == pytest.approx([0, 0, 0, 0, 0.2**2 * period])


def test_the_noise_of_a_second_does_not_depend_on_the_period():
    process = MinimumJerkProcess(jerk_noise=1.3, clock_noise=0.2)
    for period in (0.02, 0.1, 0.5):
        assert process.noise(period)[3, 3] / period == pytest.approx(1.3**2)
        assert process.noise(period)[4, 4] / period == pytest.approx(0.2**2)


@pytest.mark.parametrize("name", ["jerk_noise", "clock_noise", "shortest", "softness"])
@pytest.mark.parametrize("value", [0.0, -1.0, math.inf, math.nan])
def test_impossible_parameters_are_refused(name, value):
    with pytest.raises(InputError, match=f"{name} must be a positive number, got {value}"):
        MinimumJerkProcess(**{name: value})
