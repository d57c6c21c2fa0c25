"""The comparison: scopes, and the Pareto front of level and smooth.

Baselines
----------
K. Miettinen (1999). Nonlinear multiobjective optimization. Kluwer, chapter 2.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from .contest import Contest
from .standing import Kind, Scope, scope


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


@dataclass(frozen=True, kw_only=True, eq=False)
class Comparison:
    """Policies set against each other and against the human-human team."""

    contest: Contest
    overall: Scope
    """On all episodes."""
    behaviours: tuple[Scope, ...]
    subjects: tuple[Scope, ...]
    front: tuple[str, ...]
    """Policies that no other beats in level and smoothness, the most level first."""


def compare(contest: Contest) -> Comparison:
    """Return the comparison of the policies: overall, on each behaviour, with each subject."""
    overall = scope(contest, "all", "all", range(len(contest.team.strata)))
    points = {
        standing.name: Point(
            rmse_mm=standing.rmse_mm.mean,
            sparc=standing.sparc.mean if standing.sparc else None,
            missing=standing.sparc_missing,
        )
        for standing in overall.standings
    }
    return Comparison(
        contest=contest,
        overall=overall,
        behaviours=_parts(
            contest, "behaviour", [behaviour for behaviour, _ in contest.team.strata]
        ),
        subjects=_parts(contest, "subject", [subject for _, subject in contest.team.strata]),
        front=pareto_front(points),
    )


def _parts(contest: Contest, kind: Kind, labels: list[str]) -> tuple[Scope, ...]:
    """Return one scope a label, in order of appearance; ``labels`` has one an episode."""
    return tuple(
        scope(contest, kind, name, [i for i, label in enumerate(labels) if label == name])
        for name in dict.fromkeys(labels)
    )
