"""The best policy of a set of lifts, and rivals of a policy that are better."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.benchmark.statistics import holm_correction, paired_difference, permutation_ps_against
from colift.benchmark.validity.quantity import Quantity
from colift.benchmark.validity.scores import Scores

LEVEL: Final = 0.05
"""Largest corrected p value of a significant difference."""


@dataclass(frozen=True, kw_only=True)
class Rival:
    """Another policy, compared with one policy on the same lifts."""

    name: str
    rmse_mm: float
    """Mean RMSE of the rival [mm]."""
    behind_mm: Quantity
    """RMSE of the rival minus that of the policy [mm]: negative if the rival is better."""
    better_share: float
    """Share of the resamples in which its mean RMSE is the lower one, ties counted half."""
    p: float
    """p value for no difference, by sign flips, Holm-corrected for the number of rivals."""

    @property
    def better(self) -> bool:
        """Whether it is better than the policy, significantly."""
        return self.p <= LEVEL and self.behind_mm.value < 0.0

    @property
    def worse(self) -> bool:
        """Whether it is worse than the policy, significantly."""
        return self.p <= LEVEL and self.behind_mm.value > 0.0


def rivals(scores: Scores, policy: str) -> tuple[Rival, ...]:
    """Return the other policies compared with one, the best first.

    The test is by paired sign flips of people, corrected for all rivals, so that the search for the
    best of them is accounted for.
    """
    others = [name for name in scores.order() if name != policy]
    ps = holm_correction(
        permutation_ps_against(
            scores.errors[policy], [scores.errors[name] for name in others], scores.units
        )
    )
    return tuple(
        Rival(
            name=name,
            rmse_mm=scores.mean(name),
            behind_mm=_difference(scores, name, policy),
            better_share=_better_share(scores, name, policy),
            p=float(p),
        )
        for name, p in zip(others, ps, strict=True)
    )


def best_shares(scores: Scores) -> Mapping[str, float]:
    """Return the share of the resamples in which each policy has the lowest mean RMSE.

    Policies that are equal in a resample share it.
    """
    lowest = scores.resampled == scores.resampled.min(axis=1, keepdims=True)
    shares = (lowest / lowest.sum(axis=1, keepdims=True)).mean(axis=0)
    return dict(zip(scores.policies, np.round(shares, 6).tolist(), strict=True))


def _better_share(scores: Scores, a: str, b: str) -> float:
    first, second = (scores.resampled[:, scores.policies.index(name)] for name in (a, b))
    return float(((first < second) + 0.5 * (first == second)).mean())


def _difference(scores: Scores, a: str, b: str) -> Quantity:
    return Quantity.of(paired_difference(scores.errors[a], scores.errors[b], scores.units))
