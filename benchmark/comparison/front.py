"""Error and smoothness of a policy as a point, and the Pareto front of such points.

References
----------
K. Miettinen (1999). Nonlinear multiobjective optimization. Kluwer, chapter 2.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from ..statistics import Estimate


@dataclass(frozen=True, kw_only=True)
class FrontPoint:
    """Error and smoothness of a policy, of the human-human baseline or of a bound."""

    name: str
    rmse_mm: Estimate
    """Mean error [mm]: smaller is better."""
    sparc: Estimate | None
    """Mean smoothness over the lifts that have one: larger is better; None if none has."""
    missing: int = 0
    """Lifts without smoothness."""
    kind: Literal["policy", "baseline", "bound"] = "policy"

    @property
    def smoothness(self) -> tuple[float, float]:
        """Sort key of smoothness: first the fewest lifts without, then the mean."""
        return -self.missing, -math.inf if self.sparc is None else self.sparc.mean

    def dominates(self, other: "FrontPoint") -> bool:
        """Whether it is at least as good in both, and better in one."""
        mine = (-self.rmse_mm.mean, self.smoothness)
        theirs = (-other.rmse_mm.mean, other.smoothness)
        return mine[0] >= theirs[0] and mine[1] >= theirs[1] and mine != theirs


def exact(value: float | None) -> Estimate | None:
    """Return a mean of which no interval is known, as an estimate."""
    return None if value is None else Estimate(mean=value, ci95=(value, value))


def pareto_front(points: Sequence[FrontPoint]) -> tuple[FrontPoint, ...]:
    """Return the policies that no other dominates, in the order of their error.

    A policy without smoothness is never on the front: holding still is not smooth.
    """
    policies = [point for point in points if point.kind == "policy"]
    front = [
        point
        for point in policies
        if point.sparc and not any(rival.dominates(point) for rival in policies)
    ]
    return tuple(sorted(front, key=lambda point: (point.rmse_mm.mean, point.name)))
