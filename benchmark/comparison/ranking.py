"""Policies ranked on all episodes, on one behaviour or with one subject."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from colift.benchmark.comparison.paired_results import PairedResults, PolicyResults
from colift.benchmark.episode.metric import Metric
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL
from colift.benchmark.results.summary import Stratum
from colift.benchmark.statistics import (
    Estimate,
    FloatArray,
    PairedDifference,
    decisive,
    holm_correction,
    mean_of,
    mean_with_missing,
    permutation_ps_against,
    probability_better,
    rank_groups,
    ratio_of_means,
)

SubsetKind = Literal["all", "behaviour", "subject"]


@dataclass(frozen=True, kw_only=True)
class MetricMean:
    """The mean of a metric that some lifts do not have."""

    estimate: Estimate | None
    """Mean over the lifts that have a value; None if none has."""
    missing: int
    """Number of lifts without a value."""

    @property
    def mean(self) -> float | None:
        """The mean alone."""
        return None if self.estimate is None else self.estimate.mean


@dataclass(frozen=True, kw_only=True)
class RankedPolicy:
    """One policy, ranked among others."""

    name: str
    rank: int
    """Number of its rank group, 1 for the best; see :func:`.rank_groups`."""
    failed: int
    """Lifts that failed; they count with the worst error."""
    rmse_mm: Estimate
    vs_human: Estimate
    """RMSE over that of the human-human baseline: below 1 is better than a human partner."""
    better_than_human: float
    """Probability that its mean RMSE on such lifts is below the human-human baseline's."""
    metrics: Mapping[str, MetricMean]
    """The other metrics that boards show."""
    clipped: float | None
    """Share of its actions that were clipped; None if it never acted."""
    to_best: PairedDifference | None
    """RMSE minus that of the first in the order [mm], p Holm-corrected for the policies compared;
    None for the first itself."""


@dataclass(frozen=True, kw_only=True)
class Ranking:
    """Policies ranked on a subset of the episodes."""

    kind: SubsetKind
    name: str
    """The behaviour or the subject; ``all`` for all episodes."""
    episodes: int
    references_rmse_mm: Mapping[str, Estimate]
    """RMSE of each of :attr:`.PairedResults.references`."""
    policies: tuple[RankedPolicy, ...]
    """In the order of the mean RMSE, the best first."""
    decisive: bool
    """Whether there are enough episodes to tell any policy from the best; otherwise ranks have no
    meaning."""

    @property
    def human_human_rmse_mm(self) -> Estimate:
        """RMSE of the human-human baseline."""
        return self.references_rmse_mm[HUMAN_HUMAN_LABEL]

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
        Results of the policies, baseline and bounds.
    kind, name
        Kind and name of the subset: a behaviour, a subject, or all.
    members
        Indices of the episodes, in the suite's order.
    """
    chosen = np.array(members)
    strata = [results.human_human.strata[i] for i in members]
    human_human = np.array(results.human_human.rmse_mm)[chosen]
    errors = {policy.name: _values(policy, "rmse_mm")[chosen] for policy in results.policies}
    groups = rank_groups(errors)
    order = [name for group in groups for name in group]
    ranks = {name: rank for rank, group in enumerate(groups, 1) for name in group}
    differences = _to_best([errors[name] for name in order], strata)
    by_name = {policy.name: policy for policy in results.policies}
    return Ranking(
        kind=kind,
        name=name,
        episodes=len(members),
        references_rmse_mm={
            name: mean_of(np.array(baseline.rmse_mm)[chosen], strata)
            for name, baseline in results.references.items()
        },
        policies=tuple(
            _ranked(
                by_name[name], results.metrics, chosen, strata, human_human, ranks[name], difference
            )
            for name, difference in zip(order, differences, strict=True)
        ),
        decisive=decisive(len(errors), len(members)),
    )


def _to_best(
    errors: Sequence[FloatArray], strata: Sequence[Stratum]
) -> list[PairedDifference | None]:
    """Return the difference of each policy to the first."""
    best, *others = errors
    ps = holm_correction(permutation_ps_against(best, others))
    return [
        None,
        *(
            PairedDifference.of(error, best, strata, float(p))
            for error, p in zip(others, ps, strict=True)
        ),
    ]


def _ranked(
    policy: PolicyResults,
    metrics: Sequence[Metric],
    chosen: FloatArray,
    strata: Sequence[Stratum],
    human_human: FloatArray,
    rank: int,
    to_best: PairedDifference | None,
) -> RankedPolicy:
    rmse = _values(policy, "rmse_mm")[chosen]
    return RankedPolicy(
        name=policy.name,
        rank=rank,
        failed=sum(policy.failures[i] is not None for i in chosen),
        rmse_mm=mean_of(rmse, strata),
        vs_human=ratio_of_means(rmse, human_human, strata),
        better_than_human=probability_better(rmse, human_human, strata),
        metrics={
            metric.name: _metric_mean(_values(policy, metric.name)[chosen], strata)
            for metric in metrics
        },
        clipped=_clipped(policy, chosen),
        to_best=to_best,
    )


def _clipped(policy: PolicyResults, chosen: FloatArray) -> float | None:
    """Return the mean share of clipped actions; None if the task has no such metric."""
    if not all("clipped" in scores for scores in policy.scores):
        return None
    return mean_with_missing(_values(policy, "clipped")[chosen]).mean


def _metric_mean(values: FloatArray, strata: Sequence[Stratum]) -> MetricMean:
    known = ~np.isnan(values)
    some = [stratum for stratum, there in zip(strata, known, strict=True) if there]
    return MetricMean(
        estimate=mean_of(values[known], some) if some else None,
        missing=len(values) - len(some),
    )


def _values(policy: PolicyResults, metric: str) -> FloatArray:
    return np.array([scores[metric] for scores in policy.scores])
