"""Policies ranked on all episodes, on one behaviour or with one subject."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from colift.benchmark.comparison.paired_results import PairedResults
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.statistics import (
    Estimate,
    PairedDifference,
    decisive,
    holm_correction,
    permutation_ps_against,
    rank_groups,
)

SubsetKind = Literal["all", "behaviour", "subject"]


@dataclass(frozen=True, kw_only=True)
class RankedPolicy:
    """One policy, ranked among others."""

    name: str
    rank: int
    """Number of its rank group, 1 for the best; see :func:`.rank_groups`."""
    scores: ScoreTable
    """Its scores on these lifts."""
    rmse_mm: Estimate
    vs_human: Estimate
    """RMSE over that of the human-human baseline: below 1 is better than a human partner."""
    better_than_human: float
    """Probability that its mean RMSE on such lifts is below the human-human baseline's."""
    metrics: Mapping[str, Estimate | None]
    """The other metrics that boards show, over the lifts that have a value; None if none has."""
    to_best: PairedDifference | None
    """RMSE minus that of the first in the order [mm], p Holm-corrected for the policies compared;
    None for the first itself."""

    @property
    def failed(self) -> int:
        """Lifts that failed; they count with the worst error."""
        return self.scores.failed

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
    policies: tuple[RankedPolicy, ...]
    """In the order of the mean RMSE, the best first."""
    decisive: bool
    """Whether there are enough episodes to tell any policy from the best; otherwise ranks have no
    meaning."""

    @property
    def human_human_rmse_mm(self) -> Estimate:
        """RMSE of the human-human baseline."""
        return self.unranked_rmse_mm[HUMAN_HUMAN_LABEL]

    def best(self, ranked: RankedPolicy) -> bool:
        """Return whether a policy shares the first rank, if there are enough episodes to tell."""
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
    groups = rank_groups({name: np.array(scores.rmse_mm) for name, scores in tables.items()})
    order = [tables[name] for group in groups for name in group]
    ranks = [(name, rank) for rank, group in enumerate(groups, 1) for name in group]
    return Ranking(
        kind=kind,
        name=name,
        episodes=len(members),
        unranked_rmse_mm={
            name: baseline.select(members).error for name, baseline in results.unranked.items()
        },
        policies=tuple(
            RankedPolicy(
                name=name,
                rank=rank,
                scores=scores,
                rmse_mm=scores.error,
                vs_human=scores.against(human_human).ratio,
                better_than_human=scores.against(human_human).probability,
                metrics={each.name: scores.estimate(each.name) for each in results.metrics},
                to_best=difference,
            )
            for (name, rank), scores, difference in zip(ranks, order, _to_best(order), strict=True)
        ),
        decisive=decisive(len(tables), len(members)),
    )


def _to_best(tables: Sequence[ScoreTable]) -> list[PairedDifference | None]:
    """Return the difference of each policy to the first."""
    best, *others = tables
    ps = holm_correction(permutation_ps_against(best.rmse_mm, [each.rmse_mm for each in others]))
    tested = (each.against(best).tested(float(p)) for each, p in zip(others, ps, strict=True))
    return [None, *tested]
