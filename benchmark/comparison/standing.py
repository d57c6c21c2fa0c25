"""Estimates of each policy among the others: on all episodes, on a behaviour, with a subject."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..episode.metric import Metric
from ..results.baselines import HUMAN_HUMAN_LABEL
from ..results.summary import Stratum
from ..statistics import (
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
from .contest import Contest, Entry

Kind = Literal["all", "behaviour", "subject"]


@dataclass(frozen=True, kw_only=True)
class MetricMean:
    """The mean of a metric that some lifts do not have."""

    estimate: Estimate | None
    """Over the lifts that have one; None if none has."""
    missing: int
    """Lifts that have none."""

    @property
    def mean(self) -> float | None:
        """The mean alone."""
        return None if self.estimate is None else self.estimate.mean


@dataclass(frozen=True, kw_only=True)
class Standing:
    """One policy among others."""

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
    """Share of its actions that were cut; nothing if it never acted."""
    to_best: PairedDifference | None
    """RMSE minus that of the first in the order [mm], p Holm-corrected for the policies compared;
    None for the first itself."""

    @property
    def sparc(self) -> Estimate | None:
        """Smoothness, over the lifts that have one; None if none has."""
        return self.metrics["sparc"].estimate

    @property
    def sparc_missing(self) -> int:
        """Lifts without smoothness: the robot did not move along, or failed."""
        return self.metrics["sparc"].missing


@dataclass(frozen=True, kw_only=True)
class Scope:
    """The policies' standings on some of the episodes."""

    kind: Kind
    name: str
    """The behaviour or the subject; ``all`` for all episodes."""
    episodes: int
    baselines_rmse_mm: Mapping[str, Estimate]
    """RMSE of each of :attr:`.Contest.baselines`."""
    standings: tuple[Standing, ...]
    """In the order of the mean RMSE, the best first."""
    decisive: bool
    """Whether the episodes are enough to tell any policy from the best; else ranks say nothing."""

    @property
    def human_human_rmse_mm(self) -> Estimate:
        """RMSE of the human-human baseline."""
        return self.baselines_rmse_mm[HUMAN_HUMAN_LABEL]

    def best(self, standing: Standing) -> bool:
        """Whether a policy is the best here or cannot be told from it, as far as that is known."""
        return self.decisive and standing.rank == 1


def scope(contest: Contest, kind: Kind, name: str, members: Sequence[int]) -> Scope:
    """Return the standings on the episodes with these indices.

    Parameters
    ----------
    contest
        The policies' scores.
    kind, name
        What the episodes have in common.
    members
        Indices of the episodes, in the suite's order.
    """
    chosen = np.array(members)
    strata = [contest.human_human.strata[i] for i in members]
    human_human = np.array(contest.human_human.rmse_mm)[chosen]
    errors = {entry.name: _values(entry, "rmse_mm")[chosen] for entry in contest.entries}
    groups = rank_groups(errors)
    order = [name for group in groups for name in group]
    ranks = {name: rank for rank, group in enumerate(groups, 1) for name in group}
    differences = _to_best([errors[name] for name in order], strata)
    entries = {entry.name: entry for entry in contest.entries}
    return Scope(
        kind=kind,
        name=name,
        episodes=len(members),
        baselines_rmse_mm={
            name: mean_of(np.array(baseline.rmse_mm)[chosen], strata)
            for name, baseline in contest.baselines.items()
        },
        standings=tuple(
            _standing(
                entries[name], contest.metrics, chosen, strata, human_human, ranks[name], difference
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


def _standing(
    entry: Entry,
    metrics: Sequence[Metric],
    chosen: FloatArray,
    strata: Sequence[Stratum],
    human_human: FloatArray,
    rank: int,
    to_best: PairedDifference | None,
) -> Standing:
    rmse = _values(entry, "rmse_mm")[chosen]
    return Standing(
        name=entry.name,
        rank=rank,
        failed=sum(entry.failures[i] is not None for i in chosen),
        rmse_mm=mean_of(rmse, strata),
        vs_human=ratio_of_means(rmse, human_human, strata),
        better_than_human=probability_better(rmse, human_human, strata),
        metrics={
            metric.name: _metric_mean(_values(entry, metric.name)[chosen], strata)
            for metric in metrics
        },
        clipped=mean_with_missing(_values(entry, "clipped")[chosen]).mean,
        to_best=to_best,
    )


def _metric_mean(values: FloatArray, strata: Sequence[Stratum]) -> MetricMean:
    known = ~np.isnan(values)
    some = [stratum for stratum, there in zip(strata, known, strict=True) if there]
    return MetricMean(
        estimate=mean_of(values[known], some) if some else None,
        missing=len(values) - len(some),
    )


def _values(entry: Entry, metric: str) -> FloatArray:
    return np.array([scores[metric] for scores in entry.scores])
