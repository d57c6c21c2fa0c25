"""What the report measures beyond the benchmark's metrics: pure functions, array to number."""

from typing import Final

import numpy as np
from numpy.typing import ArrayLike

SETTLED: Final = 0.05
"""A course has settled within this share of its resting value."""


def rms(values: ArrayLike) -> float:
    """Return the root mean square of the values, those that are missing (NaN) left out."""
    return float(np.sqrt(np.nanmean(np.square(np.asarray(values, dtype=np.float64)))))


def fluctuation(course: ArrayLike) -> float:
    """Return the root mean square of the changes from step to step.

    Parameters
    ----------
    course
        Values, one a step, at least two.
    """
    return rms(np.diff(np.asarray(course, dtype=np.float64)))


def settling_steps(course: ArrayLike, *, staying: bool = False) -> int:
    """Return after how many steps a course has come to rest.

    The resting value is the mean of the last quarter of the course.

    Parameters
    ----------
    course
        Values from the step on in which the cause of the change ended.
    staying
        Whether to count up to the last time that the course is further than ``SETTLED`` from its
        resting value, noise included, instead of to its first arrival.

    Returns
    -------
    int
        Steps: 0 if the first value is already there.
    """
    x = np.asarray(course, dtype=np.float64)
    resting = x[-max(len(x) // 4, 1) :].mean()
    away = np.abs(x - resting) > SETTLED * abs(resting)
    if staying:
        return int(np.flatnonzero(away)[-1]) + 1 if away.any() else 0
    return int(np.argmin(away)) if not away.all() else len(x)
