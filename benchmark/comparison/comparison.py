"""The comparison: everything that its table, picture and page say."""

from dataclasses import dataclass

from .contest import Contest
from .front import Point, pareto_front
from .standing import Kind, Scope, scope


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
    overall = scope(contest, "all", "all", range(len(contest.team.cells)))
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
        behaviours=_parts(contest, "behaviour", [behaviour for behaviour, _ in contest.team.cells]),
        subjects=_parts(contest, "subject", [subject for _, subject in contest.team.cells]),
        front=pareto_front(points),
    )


def _parts(contest: Contest, kind: Kind, labels: list[str]) -> tuple[Scope, ...]:
    """Return one scope a label, in order of appearance; ``labels`` has one an episode."""
    return tuple(
        scope(contest, kind, name, [i for i, label in enumerate(labels) if label == name])
        for name in dict.fromkeys(labels)
    )
