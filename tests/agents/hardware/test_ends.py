"""What of a marker is seen: not one that is hidden, and not one that is frozen."""

import math

import numpy as np
import pytest
from colift.agents.hardware.ends import Height, MarkerEnds
from colift.agents.hardware.plausibility import seen

FRAME = 0.01
MARKERS = [Height(name, k, 0.001) for k, name in enumerate(("H1", "H2", "R1", "R2"))]


def played(frozen, count=30, frame=FRAME, round_to=None):
    """Return the samples of noisy markers in mm, some of which are frozen, and what was said."""
    ends, noise = MarkerEnds(MARKERS[:2], MARKERS[2:]), np.random.default_rng(1)
    samples = []
    for k in range(count):
        row = 500 + noise.normal(0.0, 0.33, 4)
        row = row if round_to is None else np.round(row / round_to) * round_to
        row[frozen] = 500.0
        samples.append(ends.sample(frame * k, row.tolist()))
    return samples, ends.unseen


@pytest.mark.parametrize(
    ("frozen", "human", "robot"),
    [([0], True, False), ([1], True, False), ([2, 3], False, True), ([0, 1, 2, 3], True, True)],
)
def test_a_marker_that_is_frozen_for_a_tenth_of_a_second_hides_its_end(frozen, human, robot):
    samples, unseen = played(frozen)
    assert all(map(seen, samples[:10]))
    for sample in samples[12:]:
        assert (math.isnan(sample.human_end), math.isnan(sample.robot_end)) == (human, robot)
    names = ", ".join(MARKERS[k].marker for k in frozen)
    assert unseen == f"{names} frozen: the same height to the bit in 10 frames or more"


def test_markers_at_rest_are_not_frozen_even_rounded_to_a_tenth_of_a_millimetre():
    for round_to in (None, 0.1):
        samples, unseen = played([], count=20_000, round_to=round_to)
        assert all(map(seen, samples))
        assert unseen == ""


def test_frames_that_are_sent_several_times_are_not_frozen():
    ends, noise = MarkerEnds(MARKERS[:2], MARKERS[2:]), np.random.default_rng(1)
    for k in range(200):
        row = (500 + noise.normal(0.0, 0.33, 4)).tolist()
        for again in range(12):
            assert seen(ends.sample(0.012 * k + 0.001 * again, row))


def test_at_fifty_frames_a_second_it_takes_ten_frames():
    samples, _ = played([0], frame=0.02)
    assert [seen(sample) for sample in samples[:11]] == [True] * 9 + [False] * 2


def test_a_frozen_marker_is_seen_again_when_it_moves():
    ends = MarkerEnds(MARKERS[:2], MARKERS[2:])
    rows = [[500.0, 500.0 + k, 500.0 + k, 500.0 + k] for k in range(20)] + [[501.0] * 4]
    samples = [ends.sample(FRAME * k, row) for k, row in enumerate(rows)]
    assert not seen(samples[-2])
    assert seen(samples[-1])
    assert ends.unseen == ""


def test_hidden_and_frozen_are_told_apart():
    ends = MarkerEnds(MARKERS[:2], MARKERS[2:])
    for k in range(20):
        ends.sample(FRAME * k, [math.nan, 500.0 + k, 500.0, 500.0 - k])
    assert ends.unseen.startswith("H1 hidden; R1 frozen")
