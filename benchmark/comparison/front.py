"""The Pareto front of level and smooth: policies that no other beats in both.

References
----------
K. Miettinen (1999). Nonlinear multiobjective optimization. Kluwer, chapter 2.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Point:
    """How level and how smooth a policy is."""

    rmse_mm: float
    """Mean error [mm]: smaller is better."""
    sparc: float | None
    """Mean smoothness over the lifts that have one: larger is better; nothing if none has."""
    missing: int = 0
    """Lifts without smoothness."""

    @property
    def smoothness(self) -> tuple[float, float]:
        """What smoothness is ranked by: first the fewest lifts without, then the mean."""
        return -self.missing, -math.inf if self.sparc is None else self.sparc

    def dominates(self, other: "Point") -> bool:
        """Whether it is at least as good in both, and better in one."""
        mine, theirs = self.smoothness, other.smoothness
        no_worse = self.rmse_mm <= other.rmse_mm and mine >= theirs
        return no_worse and (self.rmse_mm < other.rmse_mm or mine > theirs)


def pareto_front(points: Mapping[str, Point]) -> tuple[str, ...]:
    """Return the names of the points that no other dominates, the most level first.

    A policy without smoothness is never on the front: holding still is not smooth.
    """
    front = [
        name
        for name, point in points.items()
        if point.sparc is not None and not any(rival.dominates(point) for rival in points.values())
    ]
    return tuple(sorted(front, key=lambda name: (points[name].rmse_mm, name)))
