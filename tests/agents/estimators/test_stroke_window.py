"""Rest, the beginning of a stroke, and turning points are found."""

import math

import numpy as np
import pytest
from colift.agents.estimators.minimum_jerk import MinimumJerkStroke
from colift.agents.estimators.stroke_window import StrokeWindow, StrokeWindowParameters
from colift.base.errors import InputError

LIFT = MinimumJerkStroke(start=0.0, end=0.2, onset=1.03, duration=2.0)


def watch(height, until, period=0.1, noise=0.0, window=None):
    """Return the window, and when it said that the hand rests."""
    window = window or StrokeWindow()
    rng = np.random.default_rng(1)
    resting = []
    for time in period * np.arange(1 + round(until / period)):
        window.add(float(time), float(height(time)) + noise * rng.standard_normal())
        resting.append(window.resting)
    return window, np.array(resting)


@pytest.mark.parametrize("period", [0.02, 0.05, 0.1, 0.2])
def test_a_stroke_is_told_from_the_rest_before_and_after(period):
    _, resting = watch(LIFT.height, 5.0, period)
    time = period * np.arange(len(resting))
    assert resting[time <= 1.03].all()
    assert not resting[(time > 1.35) & (time < 2.7)].any()
    assert resting[time > 3.03 + 2 * period + 0.1].all()


@pytest.mark.parametrize("period", [0.01, 0.02, 0.1, 0.2])
def test_the_noise_of_motion_capture_is_hardly_ever_taken_for_a_movement(period):
    _, resting = watch(lambda _: 0.07, 60.0, period, noise=2.3e-4)
    assert resting.mean() > 0.94
    assert resting[: round(0.3 / period)].all()


@pytest.mark.parametrize("period", [0.02, 0.1])
def test_the_window_holds_the_stroke_and_the_end_of_the_rest_before(period):
    window, _ = watch(LIFT.height, 2.5, period)
    assert window.times[-1] == pytest.approx(2.5)
    assert np.diff(window.times) == pytest.approx(period)
    assert 0.7 < window.times[0] < 1.03
    assert window.heights == pytest.approx(LIFT.height(window.times))


def test_at_rest_it_holds_no_more_than_the_rest_asked_for():
    window, _ = watch(lambda _: 0.07, 6.0)
    assert window.times == pytest.approx([5.7, 5.8, 5.9, 6.0])


@pytest.mark.parametrize("sign", [-1, 1])
def test_a_turning_point_begins_a_new_stroke(sign):
    def height(time):
        return sign * 0.1 * np.sin(np.clip(time - 1.0, 0.0, None))

    turn = 1.0 + np.pi / 2
    window, resting = watch(height, turn - 0.2)
    assert window.times[0] < 1.0
    window, resting = watch(height, turn + 0.4)
    assert turn - 0.4 < window.times[0] < turn + 0.1
    assert not resting[-1]


def test_slower_than_the_rest_speed_is_rest():
    for speed, rests in ((0.007, True), (0.009, False)):
        _, resting = watch(lambda time, v=speed: v * time, 3.0)
        assert (resting[2:] == rests).all()
    quick = StrokeWindow(StrokeWindowParameters(rest_speed=0.02))
    assert watch(lambda time: 0.015 * time, 3.0, window=quick)[1].all()


@pytest.mark.parametrize("height", [math.nan, math.inf])
def test_a_height_must_be_finite(height):
    with pytest.raises(ValueError, match="height must be finite"):
        StrokeWindow().add(0.0, height)


def test_samples_must_be_in_order():
    window = StrokeWindow()
    window.add(1.0, 0.0)
    with pytest.raises(ValueError, match=r"in order of time, got 1\.0 after 1\.0"):
        window.add(1.0, 0.0)


@pytest.mark.parametrize("name", ["rest_speed", "baseline", "rest"])
@pytest.mark.parametrize("value", [0.0, -1.0, math.inf, math.nan])
def test_impossible_parameters_are_refused(name, value):
    with pytest.raises(InputError, match=f"{name} must be a positive number, got {value}"):
        StrokeWindowParameters(**{name: value})
