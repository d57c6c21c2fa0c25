"""The reported treatment is what a recording is played with."""

import numpy as np
import pytest
from colift.agents.agent import FRAME
from colift.agents.humans import SUBJECTS, Recorded, Recording
from colift.agents.humans.recorded import EASE, _retarget
from colift.agents.humans.shape import shape_of
from colift.agents.humans.treatment import treatment_of

from .motion import lift

TIMES, HEIGHTS = lift()


def recording(times, heights):
    return Recording(name="a", times=tuple(times.tolist()), heights=tuple(heights.tolist()))


DIPPING = HEIGHTS - 0.1 * np.exp(-(((TIMES - 0.6) / 0.2) ** 2))


@pytest.mark.parametrize(
    ("times", "heights", "inverted"),
    [
        (TIMES, HEIGHTS, False),
        (TIMES / 4, HEIGHTS * 4, False),
        (TIMES * 3, HEIGHTS, False),
        (TIMES, 2.0 - HEIGHTS, True),
        (TIMES, DIPPING, False),
        (*lift(30.0, top=0.05), False),
    ],
    ids=["plain", "fast and high", "slow", "downwards", "dipping", "low"],
)
def test_scale_and_slow_down_are_those_of_the_played_lift(times, heights, inverted):
    made = recording(times, heights)
    found, shape = treatment_of(Recorded(recording=made)), shape_of(made)
    target = Recorded(recording=made).plan(SUBJECTS["S1"], 0).target
    assert found.inverted is inverted
    assert target.max() == pytest.approx(found.scale * shape.highest, abs=1e-4)
    assert -target.min() <= found.scale * shape.dip + 1e-4
    assert found.slow_down >= 1.0
    # The recorded movement begins and ends with ramps, and the return overlaps the second one.
    played = _retarget(made)
    lasting = found.slow_down * (times[-1] - times[0]) + EASE
    at_end = found.scale * (1 - 2 * inverted) * (heights[-1] - heights[0])
    place = round(lasting / FRAME)
    assert played[min(place - round(EASE / FRAME / 2), len(played) - 1)] == pytest.approx(
        at_end, abs=0.01
    )


def test_the_numbers_are_those_of_the_samples():
    found = treatment_of(Recorded(recording=recording(TIMES, HEIGHTS)))
    assert found.rate_hz == pytest.approx(100.0)
    assert found.range_m == HEIGHTS.max() - HEIGHTS.min()
    assert found.plain() == {
        "rate_hz": 100.0,
        "range_m": 0.24,
        "scale": 0.8337,
        "slow_down": 1.268,
        "inverted": False,
    }
