"""A common scale of millimetres for all bars of a page."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from colift.benchmark.rendering.ticks import far_limit, round_step, round_ticks
from colift.benchmark.statistics import Estimate

MOST: Final = 5
"""Maximum number of intervals between ticks."""


@dataclass(frozen=True, kw_only=True)
class Axis:
    """A linear scale from 0 to its top."""

    top: float
    """[mm]"""
    ticks: tuple[float, ...]

    def at(self, value: float) -> float:
        """Return the position of a value [mm] in % of the width; at most 100."""
        return round(100 * min(max(value / self.top, 0.0), 1.0), 2)

    def beyond(self, value: float) -> bool:
        """Return whether a value lies off the scale."""
        return value > self.top


def make_axis(estimates: Sequence[Estimate], marks: Sequence[float] = ()) -> Axis:
    """Return a scale for means with their intervals; those far off do not stretch it.

    Parameters
    ----------
    estimates
        The drawn values, in millimetres. Means beyond :func:`.far_limit` do not count.
    marks
        Other values that must be on the scale.
    """
    far = far_limit([each.mean for each in estimates])
    highest = max([each.ends[1] for each in estimates if each.mean <= far] + [*marks, 1.0])
    step = round_step(highest, MOST)
    top = step * math.ceil(highest / step - 1e-9)
    return Axis(top=top, ticks=round_ticks(0.0, top, MOST))
