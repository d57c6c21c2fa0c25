"""Scores of poses: the ends' distances from their intended heights, and the times to settle."""

import math
from collections.abc import Sequence
from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.episode.metrics import FAILED_FRAME_MM, STROKE_TAIL, Stroke
from colift.robots.arithmetic import dot
from numpy.typing import NDArray

NEAR: Final = 0.01
"""Distance of the far end from its intended height [m] within which the pose counts as right."""

Heights = NDArray[np.float64]


def pose_rmse_mm(missed: Sequence[Heights], horizon: int) -> float:
    r"""Return the root mean square distance of the table's ends from their intended heights.

    .. math:: \sqrt{\tfrac{1}{2 H} \sum_t \left( (Z_{1t} - Z^*_{1t})^2 + (Z_{2t} - Z^*_{2t})^2
        \right)}

    Parameters
    ----------
    missed
        For each end, its height less the intended one [m], shape (T,) each.
    horizon
        Frames H that the episode should have had; each that a failure cut off counts with
        :data:`.FAILED_FRAME_MM`.

    Returns
    -------
    float
        Distance [mm].
    """
    frames = len(missed[0])
    squares = math.fsum(1e6 * float(dot(each, each)) for each in missed) / len(missed)
    return math.sqrt((squares + (horizon - frames) * FAILED_FRAME_MM**2) / horizon)


def settling_ms(missed: Heights, strokes: Sequence[Stroke]) -> float:
    """Return the time from the beginning of a movement until the far end stays at its goal.

    The far end is at its goal within :data:`NEAR` of the intended height; it is observed until
    :data:`.STROKE_TAIL` after the movement. If it never stays there, the whole time counts.

    Parameters
    ----------
    missed
        Height of the far end less the intended one [m], shape (T,).
    strokes
        Frames (start, stop) of the human's movements.

    Returns
    -------
    float
        Mean over the movements [ms]; NaN if there is none.
    """
    times = []
    for window in _windows(missed, strokes):
        away = np.flatnonzero(np.abs(window) > NEAR)
        times.append(1000 * FRAME * (int(away[-1]) + 1 if away.size else 0))
    return math.fsum(times) / len(times) if times else math.nan


def peak_mm(missed: Heights, strokes: Sequence[Stroke]) -> float:
    """Return the largest distance of the far end from its intended height in a movement [mm].

    It is the mean over the movements; arguments as for :func:`settling_ms`.
    """
    peaks = [1000 * float(np.abs(window).max()) for window in _windows(missed, strokes)]
    return math.fsum(peaks) / len(peaks) if peaks else math.nan


def opposing_work_j(force: Heights, velocity: Heights) -> float:
    r"""Return the work that the human's hands do against the robot [J].

    .. math:: W = \int \max(F v, 0) \, dt

    Parameters
    ----------
    force
        Force of the hands on the table beyond their part of its weight [N], shape (T,).
    velocity
        Velocity of the hands [m/s], shape (T,).
    """
    power = np.maximum(force * velocity, 0.0)
    return FRAME * float(power.sum())


def _windows(missed: Heights, strokes: Sequence[Stroke]) -> list[Heights]:
    tail = round(STROKE_TAIL / FRAME)
    windows = [missed[start : stop + tail] for start, stop in strokes]
    return [window for window in windows if window.size]
