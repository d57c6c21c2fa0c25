r"""The delay and the gain with which one end of a table follows the other.

The far end is modelled as

.. math:: z_2(t) = z_1(0) - d + g \, (z_1(t - \tau) - z_1(0)) + \text{rest}

with the height difference d at the start, the gain g and the delay :math:`\tau`, negative if the
far end leads. The delay of the largest correlation is found frame by frame, then refined with gain
and difference by Gauss-Newton steps of least squares. Both ends are smoothed alike first: this
changes neither delay nor gain, but without it the noise of interpolated samples, which is least
halfway between two, attracts the delay.
"""

from typing import Final, NamedTuple

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.statistics import FloatArray

LONGEST: Final = 1.0
"""Longest delay that is searched for, in either direction [s]; also at most a quarter of a lift."""

SMOOTHING: Final = 0.025
"""Standard deviation of the Gaussian kernel [s]: -3 dB at 5 Hz."""

LEAST_CORRELATION: Final = 0.5
"""Correlation below which one end does not follow the other."""

MOST_STEPS: Final = 30
"""Most Gauss-Newton steps; five suffice for a millionth of a second."""

LARGEST_STEP: Final = 2.0
"""Largest change of the delay in a step, in frames."""


class Following(NamedTuple):
    """How the far end follows the near one; NaN where the two do not move together."""

    delay: float
    """[s]"""
    gain: float
    difference: float
    """Height of the near end above the far one at the start [m]."""


NONE: Final = Following(np.nan, np.nan, np.nan)


def following(near: FloatArray, far: FloatArray, smoothing: float = SMOOTHING) -> Following:
    """Return delay, gain and height difference at the start.

    Parameters
    ----------
    near, far
        Heights of the two ends [m] at 100 Hz, shape (n,).
    smoothing
        Standard deviation of the smoothing kernel [s].
    """
    start = float(near[0])
    near, far = _smoothed(near, smoothing) - start, _smoothed(far, smoothing) - start
    most = min(round(LONGEST / FRAME), len(near) // 4)
    if most < 2:
        return NONE
    correlations = [_correlation(*_overlap(near, far, k)) for k in range(-most, most + 1)]
    first = int(np.argmax(correlations)) - most
    if correlations[first + most] < LEAST_CORRELATION or abs(first) == most:
        return NONE
    return _refined(near, far, first)


def _refined(near: FloatArray, far: FloatArray, first: int) -> Following:
    """Return the least squares fit that begins at a delay in frames."""
    frames = np.arange(len(near), dtype=np.float64)
    speed = np.gradient(near)
    # The frames are fixed, so that the sum of squares is smooth in the delay.
    margin = round(LARGEST_STEP) + 2
    inside = slice(max(first, 0) + margin, len(near) + min(first, 0) - margin)
    if inside.stop - inside.start < 2 * margin:
        return NONE
    wanted, delay = far[inside], float(first)
    offset = gain = np.nan
    for _ in range(MOST_STEPS):
        at = frames[inside] - delay
        model = np.stack([np.ones_like(at), cubic(frames, near, at), -np.interp(at, frames, speed)])
        offset, gain, slope = np.linalg.lstsq(model.T, wanted, rcond=None)[0].tolist()
        step = slope / gain if gain else np.inf
        if not abs(delay + step - first) <= LARGEST_STEP:
            return NONE
        delay += step
        if abs(step) < 1e-7:
            break
    return Following(delay * FRAME, gain, -offset)


def cubic(times: FloatArray, values: FloatArray, at: FloatArray) -> FloatArray:
    """Return values between samples, by cubic Hermite interpolation with central differences.

    Parameters
    ----------
    times, values
        The samples, shape (n,), times increasing.
    at
        Times within theirs, shape (m,).
    """
    slopes = np.gradient(values, times, edge_order=2)
    i = np.clip(np.searchsorted(times, at, side="right") - 1, 0, len(times) - 2)
    width = times[i + 1] - times[i]
    u = (at - times[i]) / width
    v = 1.0 - u
    found: FloatArray = v * v * ((1.0 + 2.0 * u) * values[i] + u * width * slopes[i]) + u * u * (
        (1.0 + 2.0 * v) * values[i + 1] - v * width * slopes[i + 1]
    )
    return found


def _smoothed(heights: FloatArray, deviation: float) -> FloatArray:
    """Return heights after a Gaussian kernel, without the frames for which it lacks neighbours."""
    reach = min(round(3.0 * deviation / FRAME), (len(heights) - 1) // 4)
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) * FRAME / deviation) ** 2)
    return np.convolve(heights, kernel / kernel.sum(), mode="valid")


def _overlap(near: FloatArray, far: FloatArray, delay: int) -> tuple[FloatArray, FloatArray]:
    """Return the frames of the near end, and those of the far end a delay later."""
    if delay < 0:
        return near[-delay:], far[:delay]
    return near[: len(near) - delay], far[delay:]


def _correlation(a: FloatArray, b: FloatArray) -> float:
    a, b = a - a.mean(), b - b.mean()
    size = float(np.sqrt((a @ a) * (b @ b)))
    return float(a @ b) / size if size > 0.0 else 0.0
