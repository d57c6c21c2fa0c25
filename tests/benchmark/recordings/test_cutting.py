"""Lifts are found where the hand rises, and only there."""

import numpy as np
import pytest
from colift.agents.estimators.minimum_jerk import profile
from colift.benchmark.recordings.cutting import Cut, lifts_in, rise_in
from hypothesis import given, settings
from hypothesis import strategies as st


def strokes(*moves, rate=100.0, base=0.9, rest=1.5):
    """Return times and heights of moves, each (start [s], duration [s], rise [m])."""
    times = np.arange(round((max(s + d for s, d, _ in moves) + rest) * rate)) / rate
    heights = np.full(len(times), base)
    for start, duration, rise in moves:
        heights += rise * profile(np.clip((times - start) / duration, 0.0, 1.0))
    return times, heights


@settings(max_examples=60, deadline=None)
@given(
    st.lists(
        st.tuples(st.floats(0.08, 0.6), st.floats(0.6, 2.5), st.floats(1.2, 3.0)),
        min_size=1,
        max_size=5,
    ),
    st.sampled_from((15.0, 30.0, 100.0, 240.0)),
)
def test_each_rise_is_one_lift_with_its_height_and_time(lifts, rate):
    moves, at = [], 1.0
    for rise, duration, rest in lifts:
        moves += [(at, duration, rise), (at + duration + rest, 1.0, -rise)]
        at += duration + 2 * rest + 1.0
    times, heights = strokes(*moves, rate=rate)
    found = lifts_in(times, heights, Cut())
    assert len(found) == len(lifts)
    for lift, (start, duration, rise) in zip(found, moves[::2], strict=True):
        [span] = lift.phases
        assert start - 0.15 <= span.start <= start + 0.35 * duration
        assert start + 0.65 * duration <= span.stop <= start + duration + 0.15
        risen = np.interp(span.stop, times, heights) - np.interp(span.start, times, heights)
        assert risen == pytest.approx(rise, rel=0.12, abs=0.01)
        assert lift.whole.start == pytest.approx(span.start - 0.5, abs=0.02)


def test_phases_follow_each_other():
    times, heights = strokes((1.0, 1.0, 0.3), (4.0, 1.5, -0.3))
    [lift] = lifts_in(times, heights, Cut(phases=3))
    rise, hold, lower = lift.phases
    assert rise.stop == hold.start
    assert hold.stop == lower.start == pytest.approx(4.15, abs=0.1)
    assert lower.stop == pytest.approx(5.35, abs=0.1)
    assert [lift.phase_at(t) for t in (0.8, 1.5, 3.0, 5.0, 5.8)] == [
        "",
        "rise",
        "hold",
        "lower",
        "",
    ]
    [rise_only] = lifts_in(times, heights, Cut())
    assert rise_only.whole.stop == pytest.approx(rise.stop + 0.5)


@pytest.mark.parametrize(("pause", "count"), [(0.5, 2), (2.5, 1)])
def test_a_pause_divides_a_rise_if_it_is_long(pause, count):
    times, heights = strokes((1.0, 1.0, 0.2), (3.8, 1.0, 0.2))
    assert len(lifts_in(times, heights, Cut(pause=pause))) == count


def test_a_reach_down_before_a_lift_is_not_part_of_it():
    times, heights = strokes((0.5, 1.0, -0.25), (2.5, 1.5, 0.22))
    [lift] = lifts_in(times, heights, Cut())
    assert lift.whole.start > 1.3
    assert rise_in(times, heights, Cut()) == pytest.approx(0.22, rel=0.1)


def test_a_recording_can_stay_whole():
    times, heights = strokes((1.0, 1.0, 0.3), (4.0, 1.0, -0.3), (6.0, 1.0, 0.2))
    [whole] = lifts_in(times, heights, Cut(phases=0))
    assert whole.whole == (times[0], times[-1])


def test_noise_of_a_depth_camera_makes_no_lifts():
    rng = np.random.default_rng(7)
    times = np.arange(0.0, 60.0, 1 / 30)
    heights = 0.9 + 0.01 * rng.standard_normal(len(times))
    assert lifts_in(times, heights, Cut()) == []
    moved = heights + 0.3 * profile(np.clip((times - 20.0) / 1.5, 0.0, 1.0))
    [lift] = lifts_in(times, moved, Cut())
    assert lift.phases[0].start == pytest.approx(20.2, abs=0.8)
    assert lift.phases[0].stop == pytest.approx(21.3, abs=0.8)


def test_small_rises_do_not_count():
    times, heights = strokes((1.0, 1.0, 0.04), (4.0, 1.0, 0.3))
    assert len(lifts_in(times, heights, Cut())) == 1
    assert len(lifts_in(times, heights, Cut(least=0.03))) == 2
