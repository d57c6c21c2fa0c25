"""What motion capture is believed."""

import math

import pytest
from colift.agents.hardware.plausibility import CaptureMonitor, at, jumped, stamped
from colift.agents.hardware.ports import Sample
from colift.agents.hardware.stops import HoldReason

NAN = math.nan


def frames(start, count, human=0.0, robot=0.0):
    return [Sample(start + 0.01 * k, human, robot) for k in range(count)]


def test_between_two_frames_it_is_linear_and_outside_nothing_is_made_up():
    two = [Sample(1.0, 0.0, 0.1), Sample(1.1, 0.2, 0.2)]
    assert at(two, 1.025) == pytest.approx((1.025, 0.05, 0.125))
    assert at(two, 0.5) == two[0]
    assert at(two, 2.0) == two[1]


@pytest.mark.parametrize(
    ("moved", "elapsed", "wrong"),
    [(0.024, 0.01, False), (0.026, 0.01, True), (0.2, 0.1, False), (0.21, 0.1, True)],
)
def test_an_end_can_move_so_fast_and_no_faster(moved, elapsed, wrong):
    before = Sample(1.0, 0.0, 0.0)
    assert jumped(before, Sample(1.0 + elapsed, moved, 0.0)) is wrong
    assert jumped(before, Sample(1.0 + elapsed, 0.0, -moved)) is wrong


def test_a_watch_tells_old_hidden_jumped_and_contradicting_frames():
    watch = CaptureMonitor()
    assert watch.judge(0.0, 0.0) is HoldReason.STALE
    watch.take(frames(0.0, 10))
    assert watch.judge(0.1, 0.0) is None
    assert watch.judge(0.28, 0.0) is None
    assert watch.judge(0.30, 0.0) is HoldReason.STALE
    watch.take([Sample(0.31, NAN, 0.0)])
    assert watch.judge(0.31, 0.0) is HoldReason.NOT_SEEN
    watch.take(frames(0.32, 2, human=0.6))
    assert watch.judge(0.33, 0.0) is HoldReason.JUMP
    watch.take(frames(0.34, 12, human=0.6))
    assert watch.judge(0.46, 0.0) is None
    watch.take(frames(0.46, 2, human=0.6, robot=0.02))
    assert watch.judge(0.47, -0.02) is None
    # The hands were at 0 within the last 150 ms, and then no more.
    watch.take(frames(0.62, 2, human=0.6, robot=0.02))
    assert watch.judge(0.63, -0.02) is HoldReason.DISAGREE


def test_a_stamp_that_cannot_be_makes_all_of_them_stale():
    assert stamped(Sample(1.02, 0.0, 0.0), 1.0)
    for time in (1.04, 1e9, NAN, math.inf, -math.inf):
        assert not stamped(Sample(time, 0.0, 0.0), 1.0)
    watch = CaptureMonitor()
    watch.take(frames(0.0, 10), misdated=1)
    assert watch.judge(0.1, 0.0) is HoldReason.STALE
    watch.take(frames(0.1, 10))
    assert watch.judge(0.2, 0.0) is None


def test_fewer_frames_than_a_quarter_of_the_usual_are_too_few():
    watch = CaptureMonitor()
    watch.take(frames(0.0, 100))
    assert (watch.rate(0.99), watch.judge(0.99, 0.0)) == (math.inf, None)
    watch.take([Sample(1.0 + 0.04 * k, 0.0, 0.0) for k in range(26)])
    assert watch.judge(2.0, 0.0) is None
    watch.take([Sample(2.05 + 0.05 * k, 0.0, 0.0) for k in range(20)])
    assert watch.rate(3.0) == 20
    assert watch.judge(3.0, 0.0) is HoldReason.FEW


def test_frames_that_come_twice_or_too_late_count_once():
    watch = CaptureMonitor()
    watch.take(frames(0.0, 5))
    watch.take([*frames(0.0, 5, human=9.0), Sample(0.05, 0.001, 0.0)])
    assert [sample.human_end for sample in watch.samples] == [0.0] * 5 + [0.001]
    assert watch.judge(0.05, 0.0) is None


def test_a_watch_forgets_what_is_older_than_a_second():
    watch = CaptureMonitor()
    watch.take(frames(0.0, 500))
    assert 100 <= len(watch.samples) <= 102
