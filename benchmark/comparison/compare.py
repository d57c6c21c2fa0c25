"""The comparison of policies: on all episodes, by behaviour, by subject; their Pareto front."""

from dataclasses import dataclass
from typing import Final

from colift.benchmark.comparison.front import FrontPoint, exact, pareto_front
from colift.benchmark.comparison.paired_results import PairedResults
from colift.benchmark.comparison.ranking import Ranking, SubsetKind, rank_policies
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL

MOST_SUBJECTS: Final = 10
"""Most subjects for results by subject: of more, each has a few lifts, which say nothing alone."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Comparison:
    """Policies compared with each other and with the human-human baseline."""

    results: PairedResults
    overall: Ranking
    """On all episodes."""
    behaviours: tuple[Ranking, ...]
    subjects: tuple[Ranking, ...]
    """Nothing where there are more than :data:`MOST_SUBJECTS`."""
    points: tuple[FrontPoint, ...]
    """The policies, the least error first; then the human-human baseline and the references."""

    @property
    def front(self) -> tuple[str, ...]:
        """The policies that no other beats in error and second metric, the least error first."""
        _, second = self.results.axes
        return tuple(point.name for point in pareto_front(self.points, second))

    @property
    def one_each(self) -> bool:
        """Whether each behaviour has one subject of its own: lifts by both are the same groups."""
        pairs = set(self.results.human_human.strata)
        return len(pairs) == len(self.behaviours) == len(self.subjects)


def compare(results: PairedResults) -> Comparison:
    """Return the comparison of the policies: overall, on each behaviour, with each subject."""
    subjects = [subject for _, subject in results.human_human.strata]
    overall = rank_policies(results, "all", "all", range(len(results.human_human.strata)))
    return Comparison(
        results=results,
        overall=overall,
        behaviours=_parts(
            results, "behaviour", [behaviour for behaviour, _ in results.human_human.strata]
        ),
        subjects=_parts(results, "subject", subjects)
        if len(set(subjects)) <= MOST_SUBJECTS
        else (),
        points=_points(results, overall),
    )


def _points(results: PairedResults, overall: Ranking) -> tuple[FrontPoint, ...]:
    _, second = results.axes
    policies = [
        FrontPoint(
            name=ranked.name,
            rmse_mm=ranked.rmse_mm,
            second=ranked.metrics[second.name],
            missing=ranked.scores.metric(second.name).missing,
        )
        for ranked in overall.policies
    ]
    others = [
        FrontPoint(
            name=name,
            rmse_mm=overall.unranked_rmse_mm[name],
            second=exact(baseline.means[second.name]),
            kind="baseline" if name == HUMAN_HUMAN_LABEL else "reference",
        )
        for name, baseline in results.unranked.items()
    ]
    return (*policies, *others)


def _parts(results: PairedResults, kind: SubsetKind, labels: list[str]) -> tuple[Ranking, ...]:
    """Return a ranking per label, in order of appearance; ``labels`` has one per episode."""
    return tuple(
        rank_policies(results, kind, name, [i for i, label in enumerate(labels) if label == name])
        for name in dict.fromkeys(labels)
    )
