"""Copies: recordings that are the same lift when they are played."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from .recorded import _retarget
from .recordings import Recording

ALIKE: Final = 0.001
"""Root mean square difference [m] of two lifts, as they are played, below which they are one.
Copies that were shifted, scaled or rounded to 1 mm differ by at most 0.7 mm; the two most alike of
the 46 lifts of HDM05 (see :mod:`.artefacts`) differ by 3.3 mm."""

AS_LONG: Final = 0.1
"""Largest relative difference between the durations of two lifts that are one."""

POINTS: Final = 200
"""Points at which lifts are compared, evenly over their durations."""


def first_copy(recordings: Sequence[Recording]) -> tuple[int, int] | None:
    """Return the places of a recording and of its first copy; None if all are different.

    Lifts are compared as they are played: at another start, at another origin or in another unit
    a recording is still the same lift.
    """
    plans = [_retarget(each) for each in recordings]
    lengths = np.array([len(plan) for plan in plans])
    sampled = np.array(
        [
            np.interp(np.linspace(0, len(plan) - 1, POINTS), np.arange(len(plan)), plan)
            for plan in plans
        ]
    )
    for i in range(1, len(plans)):
        apart = np.sqrt(np.mean((sampled[:i] - sampled[i]) ** 2, axis=1))
        alike = (apart < ALIKE) & (np.abs(lengths[:i] - lengths[i]) < AS_LONG * lengths[i])
        if alike.any():
            return int(alike.argmax()), i
    return None
