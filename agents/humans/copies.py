"""Copies: recordings of one and the same lift."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from colift.agents.humans.recorded import PEAK
from colift.agents.humans.recordings import Recording
from colift.agents.humans.shape import shape_of
from numpy.typing import NDArray

ALIKE: Final = 0.001
"""Root mean square difference [m] of two lifts, scaled to 0.20 m, below which they are one. Copies
that were shifted, scaled or rounded to 1 mm differ by at most 0.2 mm; the two most alike of the 46
lifts of HDM05 (see :mod:`.artefacts`) differ by 4.4 mm."""

POINTS: Final = 200
"""Points at which lifts are compared, evenly over their durations."""


def first_copy(recordings: Sequence[Recording]) -> tuple[int, int] | None:
    """Return the places of a recording and of its first copy; None if all are different.

    Smoothed heights are compared over the share of the duration, scaled to one range: at another
    start, pace or origin, in another unit or upside down, a recording is still the same lift.
    """
    lifts = np.array([_normal(each) for each in recordings])
    for i in range(1, len(lifts)):
        apart = np.sqrt(np.mean((lifts[:i] - lifts[i]) ** 2, axis=1))
        if apart.min() < ALIKE:
            return int((apart < ALIKE).argmax()), i
    return None


def _normal(recording: Recording) -> NDArray[np.float64]:
    heights = shape_of(recording).heights(POINTS)
    heights -= heights.min()
    heights *= PEAK / heights.max()
    return heights
