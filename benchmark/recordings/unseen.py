"""Samples at which the hand was not seen: no value, or a number that stands for none."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.humans.artefacts import STEP, UNSEEN
from colift.benchmark.recordings.motion import TOLERANCE, Series
from numpy.typing import NDArray

SLOPE: Final = 5
"""Samples on each side of a gap from which the slope at its edge is taken."""


@dataclass(frozen=True)
class Gap:
    """A run of samples at which the hand was not seen."""

    start: int
    """Its first sample."""
    stop: int
    """The first sample after it."""

    def seconds(self, times: Series) -> float:
        """Return the time between the samples on both sides [s]; to the end at an end."""
        return float(times[min(self.stop, len(times) - 1)] - times[max(self.start - 1, 0)])


def without_numbers(heights: Series, metre: float) -> tuple[Series, tuple[float, ...]]:
    """Return heights with NaN for numbers that stand for no value, and these numbers.

    They are 0, -999 and the like, in the unit of the file, far from all other heights.

    Parameters
    ----------
    heights
        [m], shape (n,).
    metre
        Metres per unit of the file.
    """
    found: list[float] = []
    kept = heights.copy()
    for value in UNSEEN:
        there = np.isclose(heights / metre, value, rtol=0.0, atol=1e-9)
        others = kept[~there & ~np.isnan(kept)]
        if not there.any() or not others.size:
            continue
        apart = float(np.abs(others - value * metre).min())
        usual = float(np.ptp(np.quantile(others, (0.05, 0.95))))
        if apart > max(STEP, 0.05 * usual):
            kept[there] = np.nan
            found.append(value)
    return kept, tuple(found)


def gaps_in(heights: Series) -> Iterator[Gap]:
    """Yield the runs of NaN."""
    edges = np.flatnonzero(np.diff(np.isnan(heights), prepend=False, append=False))
    for start, stop in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        yield Gap(start, stop)


def filled(times: Series, heights: Series, longest: float) -> tuple[Series, int]:
    """Return heights with their short gaps filled, and the number of samples that were filled.

    A gap is filled with the cubic that has heights and slopes of both sides.

    Parameters
    ----------
    times, heights
        [s], [m], shape (n,).
    longest
        Longest time between the samples on both sides of a gap that is filled [s].
    """
    made, count = heights.copy(), 0
    for gap in gaps_in(heights):
        inside = gap.start > 0 and gap.stop < len(heights)
        if inside and gap.seconds(times) <= longest + TOLERANCE:
            made[gap.start : gap.stop] = _cubic(times, heights, gap)
            count += gap.stop - gap.start
    return made, count


def _cubic(times: Series, heights: Series, gap: Gap) -> NDArray[np.float64]:
    left, right = gap.start - 1, gap.stop
    span = times[right] - times[left]
    rise = heights[right] - heights[left]
    first = span * _slope(times, heights, slice(max(left + 1 - SLOPE, 0), left + 1))
    last = span * _slope(times, heights, slice(right, right + SLOPE))
    u = (times[gap.start : gap.stop] - times[left]) / span
    return np.asarray(
        heights[left]
        + rise * u * u * (3.0 - 2.0 * u)
        + first * u * (1.0 - u) ** 2
        - last * u * u * (1.0 - u)
    )


def _slope(times: Series, heights: Series, part: slice) -> float:
    """Return the mean slope of the seen samples of a part [m/s]; 0 of fewer than two."""
    seen = ~np.isnan(heights[part])
    t, z = times[part][seen], heights[part][seen]
    if len(t) < 2:
        return 0.0
    t, z = t - t.mean(), z - z.mean()
    return float(t @ z / (t @ t))
