"""Scores of steering: the ball's distance from its target, its time to settle, and its turns."""

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from numpy.typing import NDArray

NEAR: Final = 0.02
"""Distance from the target [m] within which the ball counts as there (Liu et al. 2022)."""

LEAST_PEAK: Final = 0.03
"""Least speed of a peak of the ball's velocity, and least prominence of the peak [m/s]."""

Series = NDArray[np.float64]


def ways(target: Series) -> Iterator[slice]:
    """Yield the frames of each target after the first: from its first movement to that of the next.

    Parameters
    ----------
    target
        Intended place of the ball [m], shape (T,).
    """
    moving = np.diff(target, prepend=target[:1]) != 0.0
    starts = np.flatnonzero(moving & ~np.concatenate(([False], moving[:-1])))
    ends = [*starts.tolist(), len(target)]
    for start, stop in pairwise(ends):
        yield slice(start, stop)


def ball_settling_ms(missed: Series, target: Series) -> float:
    """Return the time from the beginning of the target's movement until the ball stays at it.

    The ball is at the target within :data:`NEAR`. If it never comes to stay there, the target's
    whole time counts.

    Parameters
    ----------
    missed, target
        Place of the ball less the target's, and the target's [m], shape (T,).

    Returns
    -------
    float
        Mean over the targets [ms]; NaN if there is none.
    """
    times = []
    for window in ways(target):
        away = np.flatnonzero(np.abs(missed[window]) > NEAR)
        times.append(1000 * FRAME * (int(away[-1]) + 1 if away.size else 0))
    return math.fsum(times) / len(times) if times else math.nan


def velocity_peaks(place: Series, target: Series) -> tuple[float, float]:
    """Return the number and the mean size of the peaks of the ball's velocity for each target.

    A peak is an extremum of the velocity, at least :data:`LEAST_PEAK` fast, from which the velocity
    then recedes by as much.

    Parameters
    ----------
    place, target
        Place of the ball and of the target [m], shape (T,).

    Returns
    -------
    tuple
        Peaks per target, and their mean speed [m/s]; NaN if there is no target or no peak.
    """
    windows = [place[window] for window in ways(target)]
    sizes = [size for window in windows if len(window) > 1 for size in _peaks(window)]
    if not windows:
        return math.nan, math.nan
    return len(sizes) / len(windows), (math.fsum(sizes) / len(sizes) if sizes else math.nan)


def _peaks(place: Series) -> list[float]:
    """Return the speeds [m/s] at the turning points of the velocity, in either direction."""
    found: list[float] = []
    low = high = 0.0
    rising = falling = True
    for speed in (np.diff(place) / FRAME).tolist():
        low, high = min(low, speed), max(high, speed)
        if rising and high - speed >= LEAST_PEAK:
            found += [high] if high >= LEAST_PEAK else []
            rising, falling, low = False, True, speed
        elif falling and speed - low >= LEAST_PEAK:
            found += [-low] if low <= -LEAST_PEAK else []
            rising, falling, high = True, False, speed
    return found
