"""Scores of steering: how near the ball is to its target, how soon, and with how many turns."""

import math
from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ....agents.agent import FRAME
from ....robots.arithmetic import dot
from ...episode.metrics import FAILED_FRAME_MM

NEAR: Final = 0.02
"""Distance from the target [m] within which the ball counts as there (Liu et al. 2022)."""

LEAST_PEAK: Final = 0.03
"""Speed [m/s] that a peak of the ball's velocity has at least, and by which it stands out."""

Series = NDArray[np.float64]


def ball_rmse_mm(missed: Series, horizon: int) -> float:
    r"""Return the root mean square distance of the ball from its target.

    .. math:: \sqrt{\tfrac{1}{H} \sum_t (s_t - s^*_t)^2}

    Parameters
    ----------
    missed
        Place of the ball less the target's [m], shape (T,).
    horizon
        Frames H that the episode should have had; each that a failure cut off counts
        :data:`.FAILED_FRAME_MM`.

    Returns
    -------
    float
        Distance [mm].
    """
    lost = (horizon - len(missed)) * FAILED_FRAME_MM**2
    return math.sqrt((1e6 * float(dot(missed, missed)) + lost) / horizon)


def leaps(target: Series) -> Iterator[slice]:
    """Yield the frames of each target after the first, from its leap to the next.

    Parameters
    ----------
    target
        Where the ball should be [m], shape (T,).
    """
    starts = [*(np.flatnonzero(np.diff(target)) + 1).tolist(), len(target)]
    for start, stop in zip(starts, starts[1:], strict=False):
        yield slice(start, stop)


def ball_settling_ms(missed: Series, target: Series) -> float:
    """Return the time from a leap of the target until the ball stays within :data:`NEAR` of it.

    A target that is never reached to stay counts its whole time.

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
    for window in leaps(target):
        away = np.flatnonzero(np.abs(missed[window]) > NEAR)
        times.append(1000 * FRAME * (int(away[-1]) + 1 if away.size else 0))
    return math.fsum(times) / len(times) if times else math.nan


def velocity_peaks(place: Series, target: Series) -> tuple[float, float]:
    """Return the number and the mean size of the peaks of the ball's velocity for each target.

    A peak is an extremum between two smaller speeds or turns, at least :data:`LEAST_PEAK` fast, and
    by as much faster than the slowest moment since the last peak of its direction.

    Parameters
    ----------
    place, target
        Place of the ball and of the target [m], shape (T,).

    Returns
    -------
    tuple
        Peaks per target, and their mean speed [m/s]; NaN if there is no target or no peak.
    """
    windows = [place[window] for window in leaps(target)]
    sizes = [size for window in windows if len(window) > 1 for size in _peaks(window)]
    if not windows:
        return math.nan, math.nan
    return len(sizes) / len(windows), (math.fsum(sizes) / len(sizes) if sizes else math.nan)


def _peaks(place: Series) -> list[float]:
    found: list[float] = []
    for sign in (1.0, -1.0):
        low, high = 0.0, 0.0
        for speed in (sign * np.diff(place) / FRAME).tolist():
            forward = max(speed, 0.0)
            if forward > high:
                high = forward
            elif high - forward >= LEAST_PEAK:
                found.append(high)
                low = high = forward
            if high - low < LEAST_PEAK:
                low = min(low, forward)
                high = max(low, forward) if forward > low else low
    return found
