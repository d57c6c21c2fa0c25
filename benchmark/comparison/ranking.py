"""Policies ranked on all episodes, on one behaviour or with one subject."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from colift.benchmark.comparison.paired_results import PairedResults
from colift.benchmark.episode.metric import Metric
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL
from colift.benchmark.results.roughness import rougher
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.statistics import (
    Estimate,
    Family,
    PairedDifference,
    all_pairs,
    decisive,
)

SubsetKind = Literal["all", "behaviour", "subject"]


@dataclass(frozen=True, kw_only=True)
class RankedPolicy:
    """One policy, ranked among others."""

    name: str
    rank: int
    """1 + the number of policies that are better beyond chance; see :attr:`.Family.ranks`."""
    scores: ScoreTable
    """Its scores on these lifts."""
    rmse_mm: Estimate
    vs_human: Estimate
    """RMSE over that of the human-human baseline, geometric mean: below 1 is better than a human
    partner."""
    better_than_human: float | None
    """Probability that ``vs_human`` is below 1 with other people; None with a single person."""
    rougher: tuple[str, ...] | None
    """Metrics by which it is rougher than two people; None if that is not known."""
    metrics: Mapping[str, Estimate | None]
    """The other metrics that boards show, over the lifts that have a value; None if none has."""
    to_best: PairedDifference | None
    """RMSE minus that of the first in the order [mm], p corrected for all pairs of policies; None
    for the first itself."""
    same_as_best: bool
    """Whether it cannot be told from the first in the order."""

    @property
    def failed(self) -> int:
        """Lifts that failed; they count with the worst error."""
        return self.scores.failed

    def partial(self, metric: Metric) -> bool:
        """Return whether the mean of a metric leaves out lifts that count as the worst."""
        found = self.scores.metric(metric.name)
        return metric.missing == "worst" and found.mean is not None and found.missing > 0

    @property
    def clipped(self) -> float | None:
        """Share of its actions that were clipped; None if it never acted or the task has none."""
        return self.scores.metric("clipped").mean if "clipped" in self.scores.values else None


@dataclass(frozen=True, kw_only=True)
class Ranking:
    """Policies ranked on a subset of the episodes."""

    kind: SubsetKind
    name: str
    """The behaviour or the subject; ``all`` for all episodes."""
    episodes: int
    unranked_rmse_mm: Mapping[str, Estimate]
    """RMSE of each of :attr:`.PairedResults.unranked`."""
    unranked_vs_human: Mapping[str, Estimate]
    """Its ratio to the human-human baseline."""
    policies: tuple[RankedPolicy, ...]
    """In the order of the mean RMSE, the best first; ranks have the same order."""
    people: int
    """Number of people in these episodes."""
    decisive: bool
    """Whether there are enough people to tell any two policies apart; otherwise ranks have no
    meaning."""

    @property
    def human_human_rmse_mm(self) -> Estimate:
        """RMSE of the human-human baseline."""
        return self.unranked_rmse_mm[HUMAN_HUMAN_LABEL]

    def best(self, ranked: RankedPolicy) -> bool:
        """Return whether no policy is better than this one, if there are enough people to tell."""
        return self.decisive and ranked.rank == 1


def rank_policies(
    results: PairedResults, kind: SubsetKind, name: str, members: Sequence[int]
) -> Ranking:
    """Rank the policies on the episodes with these indices.

    Parameters
    ----------
    results
        Results of the policies, baseline and references.
    kind, name
        Kind and name of the subset: a behaviour, a subject, or all.
    members
        Indices of the episodes, in the suite's order.
    """
    tables = {policy.name: policy.scores.select(members) for policy in results.policies}
    human_human = results.human_human.select(members)
    units = human_human.units
    family = all_pairs({name: scores.rmse_mm for name, scores in tables.items()}, units)
    unranked = {name: baseline.select(members) for name, baseline in results.unranked.items()}
    return Ranking(
        kind=kind,
        name=name,
        episodes=len(members),
        unranked_rmse_mm={name: baseline.error for name, baseline in unranked.items()},
        unranked_vs_human={
            name: baseline.against(human_human).ratio for name, baseline in unranked.items()
        },
        policies=tuple(
            RankedPolicy(
                name=name,
                rank=rank,
                scores=scores,
                rmse_mm=scores.error,
                vs_human=scores.against(human_human).ratio,
                better_than_human=scores.against(human_human).probability,
                rougher=rougher(scores, human_human, results.suite.metrics),
                metrics={each.name: scores.estimate(each.name) for each in results.metrics},
                to_best=_to_best(tables, family, name),
                same_as_best=not family.apart(name, family.names[0]),
            )
            for name, rank in family.ranks.items()
            for scores in (tables[name],)
        ),
        people=units.count,
        decisive=decisive(units.count),
    )


def _to_best(
    tables: Mapping[str, ScoreTable], family: Family, name: str
) -> PairedDifference | None:
    """Return the difference of a policy to the best."""
    best = family.names[0]
    if name == best:
        return None
    return tables[name].against(tables[best]).tested(family.p(name, best))
