"""What can be asked to go wrong, and what the motion capture makes of it."""

import math

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.hardware.faults import KINDS, Fault, Schedule, parse_fault
from colift.benchmark.hardware.markers import REST_HEIGHT, Markers


def heights(rows):
    """Return the heights of both ends above rest in each row, shape (n, 2)."""
    z = np.array([values[2::3] for _, values in rows]) - REST_HEIGHT
    return np.stack([z[:, :2].mean(axis=1), z[:, 2:].mean(axis=1)], axis=1)


def captured(fault, count=100, human=0.1, robot=0.0):
    """Return what comes out of so many frames, with the fault from the first on."""
    markers, rows = Markers(0.01), []
    for k in range(count):
        markers.capture(0.01 * k, human, robot, [fault] if fault else [])
        rows += [(0.01 * k - captured, captured, row) for captured, row in markers.due(0.01 * k)]
    return [age for age, _, _ in rows], [(when, row) for _, when, row in rows]


def test_without_a_fault_each_frame_comes_once_after_the_latency():
    ages, rows = captured(None)
    assert ages == pytest.approx([0.01] * 99)
    assert np.diff([when for when, _ in rows]) == pytest.approx(np.full(98, 0.01))
    seen = heights(rows)
    assert seen.mean(axis=0) == pytest.approx([0.1, 0.0], abs=1e-4)
    assert seen.std(axis=0) == pytest.approx([0.00023] * 2, rel=0.25)


def test_each_fault_of_the_motion_capture_does_what_it_says():
    assert captured(parse_fault("dropout@0"))[1] == []
    assert np.isnan(heights(captured(parse_fault("nan@0"))[1])[:, 0]).all()
    swapped = heights(captured(parse_fault("swap@0"))[1])
    assert swapped.mean(axis=0) == pytest.approx([0.0, 0.1], abs=1e-3)
    drifted = heights(captured(parse_fault("drift@0:9:0.2"))[1])
    assert drifted[-1] - drifted[0] == pytest.approx([0.2 * 0.98] * 2, abs=2e-3)
    assert captured(parse_fault("latency@0:9:0.3"))[0] == pytest.approx([0.31] * 69)
    ages, rows = captured(parse_fault("jitter@0:9:0.05"))
    assert min(ages) < 0.03 < 0.05 < max(ages) <= 0.07
    assert min(np.diff([when for when, _ in rows])) > 0
    back = [when for when, _ in captured(parse_fault("past-stamps@0:9:3"))[1]]
    assert back == pytest.approx(np.arange(99) * 0.01 - 3)
    kept = [when for when, _ in captured(parse_fault("loss@0:99:0.4"), count=1000)[1]]
    assert 560 < len(kept) < 640
    assert min(np.diff(kept)) > 0
    twice = [when for when, _ in captured(parse_fault("duplicate@0:99:0.5"), count=1000)[1]]
    assert 1450 < len(twice) < 1550
    assert len(set(twice)) == 999
    mixed = [when for when, _ in captured(parse_fault("reorder@0:99:0.05"), count=1000)[1]]
    assert min(np.diff(mixed)) < -0.01
    assert sorted(mixed) == pytest.approx(np.arange(len(mixed)) * 0.01, abs=0.06)


def test_planned_faults_wait_for_the_first_lift_and_asked_ones_do_not():
    schedule = Schedule([Fault(kind="nan", start=1.0, duration=2.0, value=0.0)])
    assert schedule.active(100.0) == []
    schedule.lift_begins(100.0)
    schedule.lift_begins(200.0)
    schedule.request("swap@0.5:1", 100.0)
    kinds = {
        now: {each.kind for each in schedule.active(now)} for now in (100.2, 100.7, 101.2, 104)
    }
    assert kinds == {100.2: set(), 100.7: {"swap"}, 101.2: {"nan", "swap"}, 104: set()}


def test_a_fault_without_a_duration_stays():
    assert math.isclose(parse_fault("silence@2").start, 2.0)
    assert parse_fault("silence@2").active(1e5)


@pytest.mark.parametrize("text", ["", "fire@1", "nan", "nan@", "nan@x", "nan@-1", "nan@1:2:3:4"])
def test_what_is_no_fault_is_refused(text):
    with pytest.raises(InputError, match="fault"):
        parse_fault(text)


def test_the_names_are_told():
    with pytest.raises(InputError) as refused:
        parse_fault("fire@1")
    assert all(kind in str(refused.value) for kind in KINDS)
