"""Error and second metric of a policy as a point, and the Pareto front of such points.

References
----------
K. Miettinen (1999). Nonlinear multiobjective optimization. Kluwer, chapter 2.
"""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from colift.benchmark.episode.metric import Metric
from colift.benchmark.statistics import Estimate


@dataclass(frozen=True, kw_only=True)
class FrontPoint:
    """Error and second metric of a policy, of two people or of a reference."""

    name: str
    rmse_mm: Estimate
    """Mean error [mm]: smaller is better."""
    second: Estimate | None
    """Mean of :func:`.second_axis` over the lifts that have a value; None if none has."""
    missing: int = 0
    """Lifts without a value."""
    kind: Literal["policy", "baseline", "reference"] = "policy"

    def merit(self, metric: Metric) -> tuple[float, float]:
        """Return a sort key by the second metric: fewest lifts without it first, then the mean."""
        value = -math.inf if self.second is None else metric.merit(self.second.mean)
        return -self.missing, value


def exact(value: float | None) -> Estimate | None:
    """Return a mean without a known interval as an estimate."""
    return None if value is None else Estimate(mean=value, ci95=None)


def pareto_front(points: Sequence[FrontPoint], metric: Metric) -> tuple[FrontPoint, ...]:
    """Return the policies that no other dominates, in the order of their error.

    A policy without a value of the second metric is never on the front: holding still is not
    smooth.
    """
    policies = sorted(
        (point for point in points if point.kind == "policy"),
        key=lambda point: (point.rmse_mm.mean, point.name),
    )
    front: list[FrontPoint] = []
    best: tuple[float, float] | None = None  # Of all with a smaller error.
    for _, equal in itertools.groupby(policies, key=lambda point: point.rmse_mm.mean):
        some = list(equal)
        top = max(point.merit(metric) for point in some)
        if best is None or top > best:
            front += [point for point in some if point.second and point.merit(metric) == top]
            best = top
    return tuple(front)
