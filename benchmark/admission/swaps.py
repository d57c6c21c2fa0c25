"""Pairs of policies of which each is better than the other with some people."""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.benchmark.admission.played import Played
from colift.benchmark.statistics import FloatArray, Interval, holm_correction
from colift.benchmark.statistics.student import t_cdf, t_quantile
from numpy.typing import NDArray

FAMILY: Final = 0.05
"""Probability of a false statement in a family of tests."""

LARGEST: Final = 50.0
"""Logarithm of a ratio beyond any."""


@dataclass(frozen=True, kw_only=True)
class Lead:
    """A policy that is better than another with the people for whom it was chosen."""

    policy: str
    people: int
    """Number of those for whom half of the lifts choose it, at least once."""
    ratio: float
    """Error of the other over its own, in the lifts that did not choose."""
    ci95: Interval
    """Interval that holds for all pairs of the family together."""


@dataclass(frozen=True, kw_only=True)
class Swap:
    """Two policies, each better than the other with some people."""

    leads: tuple[Lead, Lead]
    p: float
    """Holm's corrected p value: of all pairs."""

    @property
    def least(self) -> Lead:
        """The smaller lead, by the lower end of its interval."""
        return min(self.leads, key=lambda lead: lead.ci95[0])


def swaps(played: Played) -> list[Swap]:
    """Return the pairs that swap beyond chance, the clearest first; without one, the nearest to it.

    Half of a person's lifts choose the better policy of a pair for this person, the other half
    tests the choice, and then the halves change places. Where one policy is at least as good with
    everybody, a choice of the other is chance, and the lifts that test it show no lead. A lead is
    the mean logarithm of the ratio of the mean errors over all tests of a choice, with the
    jackknife's standard error over people. A swap needs both leads, so that its p value is the
    larger one of two one-sided tests; the p values of all pairs are corrected together by Holm's
    method.
    """
    first, second = (np.log(played.errors[..., half::2].mean(axis=-1)) for half in (0, 1))
    one, other = np.triu_indices(len(played.players), 1)
    early, late = first[one] - first[other], second[one] - second[other]
    tail = FAMILY / len(one)
    leads = _tested(-early, -late, tail), _tested(early, late, tail)
    corrected = holm_correction(np.maximum(leads[0].p, leads[1].p))
    order = np.argsort(-np.minimum(leads[0].low, leads[1].low), kind="stable").tolist()
    return [
        Swap(
            leads=(
                leads[0].lead(pair, played.players[one[pair]]),
                leads[1].lead(pair, played.players[other[pair]]),
            ),
            p=float(corrected[pair]),
        )
        for rank, pair in enumerate(order)
        if rank == 0 or corrected[pair] <= FAMILY
    ]


@dataclass(frozen=True, kw_only=True, eq=False)
class _Tested:
    """The leads of one policy of each pair, as logarithms, each of shape (pairs,)."""

    mean: FloatArray
    low: FloatArray
    """Lower end of the interval that holds for all pairs; -:data:`LARGEST` without two people."""
    people: NDArray[np.int64]
    p: FloatArray

    def lead(self, pair: int, policy: str) -> Lead:
        """Return the lead of a pair."""
        mean, low = float(self.mean[pair]), float(self.low[pair])
        low, ratio, high = (math.exp(each) for each in (low, mean, 2 * mean - low))
        return Lead(policy=policy, people=int(self.people[pair]), ratio=ratio, ci95=(low, high))


def _tested(first: FloatArray, second: FloatArray, tail: float) -> _Tested:
    """Return the leads of the policy that is better where the halves (pairs, people) are positive.

    A lead is the sum of one half's differences with the people for whom the other half is positive,
    over the number of these tests.
    """
    chosen = (first > 0).astype(np.float64) + (second > 0)
    gained = np.where(first > 0, second, 0.0) + np.where(second > 0, first, 0.0)
    count, people = chosen.sum(axis=1), (chosen > 0).sum(axis=1)
    mean = gained.sum(axis=1) / np.maximum(count, 1.0)
    rest = np.maximum(count[:, np.newaxis] - chosen, 1.0)
    without = (gained.sum(axis=1)[:, np.newaxis] - gained) / rest
    spread = np.where(chosen > 0, without - mean[:, np.newaxis], 0.0)
    error = np.sqrt(np.maximum(people - 1, 0) / np.maximum(people, 1) * (spread**2).sum(axis=1))
    known = (people >= 2) & (error > 0)
    reach = np.array([t_quantile(1.0 - tail, max(number - 1, 1)) for number in people.tolist()])
    p = [
        max(1.0 - t_cdf(lead / wide, number - 1), 0.0) if tested else 1.0
        for lead, wide, number, tested in zip(
            mean.tolist(), error.tolist(), people.tolist(), known.tolist(), strict=True
        )
    ]
    low = np.where(known, mean - reach * error, -LARGEST)
    return _Tested(mean=mean, low=low, people=people, p=np.array(p))
