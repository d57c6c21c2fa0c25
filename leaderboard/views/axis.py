"""A common scale of millimetres for all bars of a page."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ...benchmark.comparison.scale import FAR
from ...benchmark.statistics import Estimate

STEPS: Final = (1.0, 2.0, 5.0, 10.0)
"""Distances of ticks, up to a power of ten."""

MOST: Final = 5
"""Intervals between ticks, at most."""


@dataclass(frozen=True, kw_only=True)
class Axis:
    """A linear scale from 0 to its top."""

    top: float
    """[mm]"""
    ticks: tuple[float, ...]

    def at(self, value: float) -> float:
        """Return where a value [mm] is drawn [% of the breadth]; what is beyond, at 100."""
        return round(100 * min(max(value / self.top, 0.0), 1.0), 2)

    def beyond(self, value: float) -> bool:
        """Whether a value lies off the scale."""
        return value > self.top


def make_axis(estimates: Sequence[Estimate], marks: Sequence[float] = ()) -> Axis:
    """Return a scale for means with their intervals; those far off do not stretch it.

    Parameters
    ----------
    estimates
        What is drawn, in millimetres. Means above :data:`.FAR` times the median do not count.
    marks
        Other values that must be on the scale.
    """
    far = FAR * float(np.median([each.mean for each in estimates])) if estimates else 0.0
    highest = max([each.ci95[1] for each in estimates if each.mean <= far] + [*marks, 1.0])
    power = 10.0 ** math.floor(math.log10(highest / MOST))
    step = next(power * each for each in STEPS if power * each * MOST >= highest)
    count = math.ceil(highest / step - 1e-9)
    return Axis(top=step * count, ticks=tuple(step * i for i in range(count + 1)))
