import numpy as np
import pytest
from colift.agents.agent import FRAME
from colift.agents.control.anticipation import MODES
from colift.benchmark.training.labels import AHEAD, modes, stroke_ends, velocities

SPEED = 0.1


def moved(*legs):
    """Return heights after legs of (velocity [m/s], duration [s]), from 0."""
    steps = np.concatenate([np.full(round(time / FRAME), speed) for speed, time in legs])
    return np.concatenate(([0.0], FRAME * np.cumsum(steps)))


def names(heights):
    found = modes(heights)
    assert (found.sum(axis=1) == 1.0).all()
    return [MODES[i] for i in found.argmax(axis=1)]


def order(heights):
    told = names(heights)
    return [name for name, last in zip(told, [None, *told], strict=False) if name != last]


def test_a_lift_that_pauses_goes_through_the_modes_in_order():
    heights = moved((0, 1), (SPEED, 1), (0, 1), (SPEED, 1), (0, 1))
    once = ["rest", "onset", "stroke", "pause"]
    assert order(heights) == [*once, *once, "rest"]


def test_turning_back_is_a_reversal():
    told = names(moved((0, 1), (SPEED, 1), (-SPEED, 1), (0, 1)))
    turn = round(2 / FRAME)
    assert set(told[turn - 26 : turn - 4]) == {"reversal"}
    assert told[turn - 40] == told[turn + 10] == "stroke"


def test_an_event_is_told_as_long_before_as_said():
    told = names(moved((0, 1), (SPEED, 1), (0, 1)))
    first = told.index("onset")
    assert told.index("stroke") - first == pytest.approx(AHEAD / FRAME, abs=1)
    assert told.index("rest", first) - told.index("pause") == pytest.approx(AHEAD / FRAME, abs=1)


def test_velocity_is_that_of_a_steady_motion():
    assert velocities(moved((SPEED, 1)))[5:-5] == pytest.approx(SPEED)


def test_a_tremor_is_no_motion():
    time = FRAME * np.arange(300)
    assert set(names(0.00015 * np.sin(2 * np.pi * 8 * time))) == {"rest"}


def test_a_stroke_ends_where_it_stops_or_turns():
    heights = moved((0, 1), (SPEED, 1), (-SPEED, 0.5), (0, 1))
    ends = stroke_ends(heights)
    assert ends[150] == pytest.approx(SPEED, abs=0.003)
    assert ends[225] == pytest.approx(SPEED * 0.5, abs=0.003)
    assert ends[50] == 0.0
    assert ends[-1] == heights[-1]


def test_a_lift_that_is_cut_off_ends_there():
    heights = moved((0, 0.2), (SPEED, 0.5))
    assert stroke_ends(heights)[40] == pytest.approx(heights[-1], abs=0.005)
    assert modes(heights[:5]).shape == (5, 5)
