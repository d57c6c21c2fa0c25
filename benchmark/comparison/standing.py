"""Where each policy stands among the others: on all episodes, on a behaviour, with a subject."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..statistics import (
    FloatArray,
    Interval,
    holm_correction,
    paired_difference,
    permutation_ps_against,
    probability_better,
    rank_groups,
    ratio_of_means_ci,
    share_better,
    stratified_bootstrap,
)
from ..summary import Cell
from .contest import TEAM, Contest, Entry

Kind = Literal["all", "behaviour", "subject"]


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """A mean over episodes."""

    mean: float
    ci95: Interval
    """95 % confidence interval, by bootstrap over the seeds within behaviour and subject."""


@dataclass(frozen=True, kw_only=True)
class Difference:
    """How far a policy is behind the best, lift by lift."""

    mean: float
    """Mean of its RMSE minus the best's [mm]."""
    ci95: Interval
    """95 % confidence interval of the mean [mm]."""
    p: float
    """p value of "they do not differ", by sign flips, Holm-corrected for the policies compared."""
    share_better: float
    """Share of the lifts in which it is better than the best, ties counted half."""


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
    """RMSE over that of the human-human team: below 1 is better than a human partner."""
    better_than_human: float
    """Probability that its mean RMSE on such lifts is below the human-human team's."""
    sparc: Estimate | None
    """Smoothness, over the lifts that have one; nothing if none has."""
    sparc_missing: int
    """Lifts without smoothness: the robot did not move along, or failed."""
    human_force_n: float | None
    """Mean of the rms force at the human's hands [N]."""
    to_best: Difference | None
    """Against the first in the order; nothing for the first itself."""


@dataclass(frozen=True, kw_only=True)
class Scope:
    """The policies' standings on some of the episodes."""

    kind: Kind
    name: str
    """The behaviour or the subject; ``all`` for all episodes."""
    episodes: int
    references_rmse_mm: Mapping[str, Estimate]
    """RMSE of each of :attr:`.Contest.references`."""
    standings: tuple[Standing, ...]
    """In the order of the mean RMSE, the best first."""

    @property
    def team_rmse_mm(self) -> Estimate:
        """RMSE of the human-human team."""
        return self.references_rmse_mm[TEAM]


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
    cells = [contest.team.cells[i] for i in members]
    team = np.array(contest.team.rmse_mm)[chosen]
    errors = {entry.name: _values(entry, "rmse_mm")[chosen] for entry in contest.entries}
    groups = rank_groups(errors)
    order = [name for group in groups for name in group]
    ranks = {name: rank for rank, group in enumerate(groups, 1) for name in group}
    differences = _to_best([errors[name] for name in order], cells)
    entries = {entry.name: entry for entry in contest.entries}
    return Scope(
        kind=kind,
        name=name,
        episodes=len(members),
        references_rmse_mm={
            name: _estimate(np.array(reference.rmse_mm)[chosen], cells)
            for name, reference in contest.references.items()
        },
        standings=tuple(
            _standing(entries[name], chosen, cells, team, ranks[name], difference)
            for name, difference in zip(order, differences, strict=True)
        ),
    )


def _to_best(errors: Sequence[FloatArray], cells: Sequence[Cell]) -> list[Difference | None]:
    """Return the difference of each policy to the first."""
    best, *others = errors
    ps = holm_correction(permutation_ps_against(best, others))
    differences: list[Difference | None] = [None]
    for error, p in zip(others, ps, strict=True):
        difference = paired_difference(error, best, cells)
        differences.append(
            Difference(
                mean=difference.mean,
                ci95=difference.ci95,
                p=float(p),
                share_better=share_better(error, best),
            )
        )
    return differences


def _standing(
    entry: Entry,
    chosen: FloatArray,
    cells: Sequence[Cell],
    team: FloatArray,
    rank: int,
    to_best: Difference | None,
) -> Standing:
    rmse = _values(entry, "rmse_mm")[chosen]
    sparc = _values(entry, "sparc")[chosen]
    force = _values(entry, "human_force_n")[chosen]
    moved = ~np.isnan(sparc)
    felt = force[~np.isnan(force)]
    return Standing(
        name=entry.name,
        rank=rank,
        failed=sum(entry.failures[i] is not None for i in chosen),
        rmse_mm=_estimate(rmse, cells),
        vs_human=Estimate(
            mean=float(rmse.mean() / team.mean()), ci95=ratio_of_means_ci(rmse, team, cells)
        ),
        better_than_human=probability_better(rmse, team, cells),
        sparc=_estimate(sparc[moved], [c for c, m in zip(cells, moved, strict=True) if m])
        if moved.any()
        else None,
        sparc_missing=int((~moved).sum()),
        human_force_n=float(felt.mean()) if felt.size else None,
        to_best=to_best,
    )


def _estimate(values: FloatArray, cells: Sequence[Cell]) -> Estimate:
    return Estimate(mean=float(values.mean()), ci95=stratified_bootstrap(values, cells))


def _values(entry: Entry, metric: str) -> FloatArray:
    return np.array([getattr(scores, metric) for scores in entry.scores])
