"""The lifts of a session so far, and what they say about the present one."""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Recollection(NamedTuple):
    """The coming heights, by the lifts before."""

    rise: float
    """Mean rise until the horizon [m]."""
    spread: float
    """Standard deviation of the rise among the lifts that fit [m]."""


@dataclass(kw_only=True)
class PastLifts:
    """The seen heights of earlier lifts, one per control step, and a search for what fits now.

    The last heights of this lift are compared with those of each lift j before, d steps earlier or
    later than now. With the mean squared difference e(j, d), the weight of a place is

        w(j, d) ~ recency^j exp(-e(j, d) / (2 error^2) - (d dt)^2 / (2 timing^2)),

    j = 0 being the last lift, and the rise is the weighted mean of those that followed.
    """

    window: int = 8
    """Steps that are compared."""
    error: float = 0.004
    """Height difference at which a place fits less [m]."""
    timing: float = 0.6
    """Time by which people begin earlier or later [s]."""
    recency: float = 0.8
    """Weight of a lift relative to that of the next."""
    farthest: int = 20
    """Most steps earlier or later."""
    lifts: list[Array] = field(default_factory=list)
    """Heights of each lift [m], the last one first."""

    def add(self, heights: list[float]) -> None:
        """Add the lift that has ended."""
        if len(heights) > 1:
            self.lifts.insert(0, np.array(heights))

    def recollect(self, heights: list[float], ahead: float, period: float) -> Recollection | None:
        """Return what follows the heights of this lift so far; None if there was no lift before.

        Parameters
        ----------
        heights
            Seen heights, one per step [m].
        ahead
            The horizon, in steps after the last of them.
        period
            Control period [s].
        """
        if not self.lifts:
            return None
        now = len(heights) - 1
        recent = np.array([heights[max(now - i, 0)] for i in range(self.window)])
        shifts = np.arange(-self.farthest, self.farthest + 1)
        late = 0.5 * (shifts * period / self.timing) ** 2
        costs, rises = [], []
        for age, past in enumerate(self.lifts):
            last = len(past) - 1
            places = now + shifts
            seen = past[np.clip(places[:, None] - np.arange(self.window), 0, last)]
            apart = ((seen - recent) ** 2).mean(axis=1)
            costs.append(apart / (2 * self.error**2) + late - age * np.log(self.recency))
            then = np.interp(places + ahead, np.arange(last + 1), past)
            rises.append(then - past[np.clip(places, 0, last)])
        cost, rise = np.concatenate(costs), np.concatenate(rises)
        weights = np.exp(cost.min() - cost)
        weights /= weights.sum()
        mean = float((weights * rise).sum())
        return Recollection(mean, float(((weights * (rise - mean) ** 2).sum()) ** 0.5))
