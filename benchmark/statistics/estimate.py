"""Means, ratios and differences of means, each with its 95 % confidence interval."""

from collections.abc import Hashable, Iterable
from dataclasses import dataclass
from typing import Self

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.statistics.bootstrap import expanded_percentile, stratified_bootstrap
from colift.benchmark.statistics.samples import (
    FloatArray,
    Interval,
    members_of,
    paired,
    resampled,
    sample,
)
from colift.benchmark.statistics.superiority import share_better
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """A mean over episodes, or a ratio or difference of such means."""

    mean: float
    ci95: Interval
    """95 % confidence interval, by bootstrap over the seeds within behaviour and subject."""

    def rounded(self, places: int) -> "Estimate":
        """Return mean and interval rounded to ``places`` decimals."""
        low, high = self.ci95
        return Estimate(
            mean=round(self.mean, places), ci95=(round(low, places), round(high, places))
        )


@dataclass(frozen=True, kw_only=True)
class PairedDifference(Estimate):
    """Mean difference of two policies on the same episodes, with its significance."""

    p: float
    """p value for the hypothesis that they do not differ, by sign flips."""
    share_better: float
    """Share of the episodes in which the first is better (smaller), ties counted half."""

    @classmethod
    def of(cls, a: ArrayLike, b: ArrayLike, strata: Iterable[Hashable], p: float) -> Self:
        """Return the difference a - b; see :func:`paired_difference`."""
        found = paired_difference(a, b, strata)
        return cls(mean=found.mean, ci95=found.ci95, p=p, share_better=share_better(a, b))


def mean_of(
    values: ArrayLike, strata: Iterable[Hashable], *, resamples: int = 2000, seed: int = 0
) -> Estimate:
    """Return the mean with its 95 % interval; arguments as for :func:`.stratified_bootstrap`."""
    x = sample("values", values)
    ci95 = stratified_bootstrap(x, strata, resamples=resamples, seed=seed)
    return Estimate(mean=float(x.mean()), ci95=ci95)


def ratio_of_means(
    numerator: ArrayLike,
    denominator: ArrayLike,
    strata: Iterable[Hashable],
    *,
    resamples: int = 2000,
    confidence: float = 0.95,
    seed: int = 0,
) -> Estimate:
    """Return mean(numerator) / mean(denominator) with its 95 % interval.

    Both means take the same resampled episodes, so that the common difficulty of an episode
    cancels.

    Parameters
    ----------
    numerator, denominator
        Values of the same episodes in the same order, each of shape (n,); the denominator positive.
    strata, resamples, confidence, seed
        As for :func:`stratified_bootstrap`.

    Returns
    -------
    Estimate
        Ratio and interval, dimensionless.

    Raises
    ------
    InputError
        If the values are empty, not finite, of unequal length, or a denominator is not positive.
    """
    a, b = paired("numerator", numerator, "denominator", denominator)
    if b.min() <= 0.0:
        raise InputError(f"denominator {b.min()} of episode {b.argmin()} must be positive")
    members = members_of(strata, a.size)
    ratios = resampled(
        lambda drawn: a[drawn].mean(axis=-1) / b[drawn].mean(axis=-1), members, resamples, seed
    )
    return Estimate(
        mean=float(a.mean() / b.mean()), ci95=expanded_percentile(ratios, members, confidence)
    )


def difference_of_means(
    a: ArrayLike,
    strata_a: Iterable[Hashable],
    b: ArrayLike,
    strata_b: Iterable[Hashable],
    *,
    resamples: int = 2000,
    confidence: float = 0.95,
    seed: int = 0,
) -> Estimate:
    """Return mean(a) - mean(b), of different episodes, with its 95 % interval.

    For the same episodes, use :func:`paired_difference`.

    Parameters
    ----------
    a, b
        Values of two sets of episodes, of shapes (n,) and (m,).
    strata_a, strata_b
        The stratum of each episode; the strata of the two sets are different ones.
    resamples, confidence, seed
        As for :func:`stratified_bootstrap`.

    Returns
    -------
    Estimate
        Difference and interval, in the unit of the values.

    Raises
    ------
    InputError
        As :func:`stratified_bootstrap`.
    """
    x, y = sample("a", a), sample("b", b)
    members_a, members_b = members_of(strata_a, x.size), members_of(strata_b, y.size)
    members = [*members_a, *(stratum + x.size for stratum in members_b)]
    both = np.concatenate((x, y))

    def difference(drawn: NDArray[np.intp]) -> FloatArray:
        values = both[drawn]
        means: FloatArray = values[:, : x.size].mean(axis=-1) - values[:, x.size :].mean(axis=-1)
        return means

    differences = resampled(difference, members, resamples, seed)
    interval = expanded_percentile(differences, members, confidence)
    return Estimate(mean=float(x.mean() - y.mean()), ci95=interval)


def paired_difference(
    a: ArrayLike,
    b: ArrayLike,
    strata: Iterable[Hashable],
    *,
    resamples: int = 2000,
    seed: int = 0,
) -> Estimate:
    """Return the mean of a - b over the same episodes, with its 95 % confidence interval.

    Parameters
    ----------
    a, b
        Values of two policies on the same episodes in the same order, each of shape (n,).
    strata, resamples, seed
        As for :func:`stratified_bootstrap`.

    Returns
    -------
    Estimate
        Mean and interval, in the unit of the values.

    Raises
    ------
    InputError
        If the values are empty, not finite or of unequal length.
    """
    x, y = paired("a", a, "b", b)
    return mean_of(x - y, strata, resamples=resamples, seed=seed)
