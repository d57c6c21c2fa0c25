"""The comparison of policies: on all episodes, by behaviour, by subject; their Pareto front."""

from dataclasses import dataclass

from ..results.baselines import HUMAN_HUMAN_LABEL
from .contest import Contest
from .front import Point, exact, pareto_front
from .standing import Kind, Scope, scope


@dataclass(frozen=True, kw_only=True, eq=False)
class Comparison:
    """Policies set against each other and against the human-human baseline."""

    contest: Contest
    overall: Scope
    """On all episodes."""
    behaviours: tuple[Scope, ...]
    subjects: tuple[Scope, ...]
    points: tuple[Point, ...]
    """The policies, the most level first; then the human-human baseline and the bounds."""

    @property
    def front(self) -> tuple[str, ...]:
        """The policies that no other beats in error and in smoothness, the most level first."""
        return tuple(point.name for point in pareto_front(self.points))


def compare(contest: Contest) -> Comparison:
    """Return the comparison of the policies: overall, on each behaviour, with each subject."""
    overall = scope(contest, "all", "all", range(len(contest.human_human.strata)))
    return Comparison(
        contest=contest,
        overall=overall,
        behaviours=_parts(
            contest, "behaviour", [behaviour for behaviour, _ in contest.human_human.strata]
        ),
        subjects=_parts(contest, "subject", [subject for _, subject in contest.human_human.strata]),
        points=_points(contest, overall),
    )


def _points(contest: Contest, overall: Scope) -> tuple[Point, ...]:
    policies = [
        Point(
            name=standing.name,
            rmse_mm=standing.rmse_mm,
            sparc=standing.sparc,
            missing=standing.sparc_missing,
        )
        for standing in overall.standings
    ]
    others = [
        Point(
            name=name,
            rmse_mm=overall.baselines_rmse_mm[name],
            sparc=exact(baseline.means["sparc"]),
            kind="baseline" if name == HUMAN_HUMAN_LABEL else "bound",
        )
        for name, baseline in contest.baselines.items()
    ]
    return (*policies, *others)


def _parts(contest: Contest, kind: Kind, labels: list[str]) -> tuple[Scope, ...]:
    """Return one scope a label, in order of appearance; ``labels`` has one an episode."""
    return tuple(
        scope(contest, kind, name, [i for i, label in enumerate(labels) if label == name])
        for name in dict.fromkeys(labels)
    )
