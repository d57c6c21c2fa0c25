"""Confidence intervals, by a bootstrap within the cells of a suite."""

from collections.abc import Callable, Hashable, Iterable
from dataclasses import dataclass
from statistics import NormalDist
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...agents.errors import InputError
from .resampling import Cells, cells_of, expanded, resample
from .samples import FloatArray, Interval, paired, sample


@dataclass(frozen=True, kw_only=True)
class PairedDifference:
    """Mean difference of two policies on the same episodes."""

    mean: float
    """Mean of a - b, in the unit of the values."""
    ci95: Interval
    """95 % confidence interval of the mean."""


def stratified_bootstrap(
    values: ArrayLike,
    strata: Iterable[Hashable],
    statistic: Callable[..., Any] = np.mean,
    *,
    resamples: int = 2000,
    confidence: float = 0.95,
    seed: int = 0,
) -> Interval:
    r"""Return a confidence interval of a statistic of the pooled values.

    Each resample draws the episodes of every cell anew, with replacement, from that cell. The
    interval is Hesterberg's expanded percentile interval: the quantiles :math:`q` and
    :math:`1 - q` of the resampled statistic with

    .. math:: q = \Phi\left(-\sqrt{\tfrac{n}{n - c}} \; t_{(1 + \text{confidence}) / 2, \, n - c}
        \right)

    for n episodes in c cells of two or more. Resampling m episodes understates their variance by
    (m - 1) / m; the factor corrects that exactly for the mean over cells of one size or one
    variance. In simulations of 4 to 20 cells of 3 to 15 episodes, 95 % intervals of the mean
    covered 94 to 96 % for normal values. For moderately skewed ones (log-normal, sigma 0.5) they
    covered 93 to 94 %, but 90 to 92 % in four or five cells of three; for strongly skewed ones
    (sigma 1) 89 to 93 %, and 84 to 88 % in five cells of two. With the errors that the
    human-human team and ``copy`` make on the standard suite, 94 to 95 %; drawn as ``quick-v1``
    has them, three in each of four cells of which one varies most, 89 to 93 %. The plain
    percentile interval covers 86 to 88 % in cells of three.

    A cell of one episode cannot vary: it is kept as it is and adds no width, so the interval of a
    suite with one seed has no width and means nothing.

    Parameters
    ----------
    values
        One value an episode, shape (n,).
    strata
        The cell of each episode, for example ``(subject, behaviour)``; n of them.
    statistic
        Function of an array and ``axis=-1``, such as ``numpy.mean`` or
        :func:`.interquartile_mean`.
    resamples
        Number of resamples.
    confidence
        Coverage of the interval, between 0 and 1.
    seed
        Seed of the resampling: the same inputs give the same interval.

    Returns
    -------
    tuple of float
        Lower and upper end, in the unit of the statistic.

    Raises
    ------
    InputError
        If ``values`` is empty or not finite, ``strata`` has another length, or ``confidence`` is
        not between 0 and 1.
    """
    x = sample("values", values)
    cells = cells_of(strata, x.size)
    drawn = resample(cells, resamples, seed)
    return _expanded_percentile(statistic(x[drawn], axis=-1), cells, confidence)


def ratio_of_means_ci(
    numerator: ArrayLike,
    denominator: ArrayLike,
    strata: Iterable[Hashable],
    *,
    resamples: int = 2000,
    confidence: float = 0.95,
    seed: int = 0,
) -> Interval:
    """Return a confidence interval of mean(numerator) / mean(denominator).

    Both means take the same resampled episodes: what makes an episode hard for both cancels.

    Parameters
    ----------
    numerator, denominator
        Values of the same episodes in the same order, each of shape (n,); the denominator positive.
    strata, resamples, confidence, seed
        As for :func:`stratified_bootstrap`.

    Returns
    -------
    tuple of float
        Lower and upper end, dimensionless.

    Raises
    ------
    InputError
        If the values are empty, not finite, of unequal length, or a denominator is not positive.
    """
    a, b = paired("numerator", numerator, "denominator", denominator)
    if b.min() <= 0.0:
        raise InputError(f"denominator {b.min()} of episode {b.argmin()} must be positive")
    cells = cells_of(strata, a.size)
    drawn = resample(cells, resamples, seed)
    ratios = a[drawn].mean(axis=-1) / b[drawn].mean(axis=-1)
    return _expanded_percentile(ratios, cells, confidence)


def difference_of_means_ci(
    a: ArrayLike,
    strata_a: Iterable[Hashable],
    b: ArrayLike,
    strata_b: Iterable[Hashable],
    *,
    resamples: int = 2000,
    confidence: float = 0.95,
    seed: int = 0,
) -> Interval:
    """Return a confidence interval of mean(a) - mean(b), of different episodes.

    For the same episodes, :func:`paired_difference` says more.

    Parameters
    ----------
    a, b
        Values of two sets of episodes, of shapes (n,) and (m,).
    strata_a, strata_b
        The cell of each episode; a cell of one set is none of the other's.
    resamples, confidence, seed
        As for :func:`stratified_bootstrap`.

    Returns
    -------
    tuple of float
        Lower and upper end, in the unit of the values.

    Raises
    ------
    InputError
        As :func:`stratified_bootstrap`.
    """
    x, y = sample("a", a), sample("b", b)
    cells_a, cells_b = cells_of(strata_a, x.size), cells_of(strata_b, y.size)
    cells = [*cells_a, *(cell + x.size for cell in cells_b)]
    drawn = np.concatenate((x, y))[resample(cells, resamples, seed)]
    differences = drawn[:, : x.size].mean(axis=-1) - drawn[:, x.size :].mean(axis=-1)
    return _expanded_percentile(differences, cells, confidence)


def paired_difference(
    a: ArrayLike,
    b: ArrayLike,
    strata: Iterable[Hashable],
    *,
    resamples: int = 2000,
    seed: int = 0,
) -> PairedDifference:
    """Return the mean of a - b over the same episodes, with its 95 % confidence interval.

    Parameters
    ----------
    a, b
        Values of two policies on the same episodes in the same order, each of shape (n,).
    strata, resamples, seed
        As for :func:`stratified_bootstrap`.

    Returns
    -------
    PairedDifference
        Mean and interval, in the unit of the values.

    Raises
    ------
    InputError
        If the values are empty, not finite or of unequal length.
    """
    x, y = paired("a", a, "b", b)
    ci95 = stratified_bootstrap(x - y, strata, resamples=resamples, seed=seed)
    return PairedDifference(mean=float((x - y).mean()), ci95=ci95)


def _expanded_percentile(resampled: FloatArray, cells: Cells, confidence: float) -> Interval:
    if not 0.0 < confidence < 1.0:
        raise InputError(f"confidence is {confidence}; it must lie between 0 and 1, such as 0.95")
    z = NormalDist().inv_cdf((1.0 + confidence) / 2.0)
    tail = NormalDist().cdf(-expanded(z, cells))
    low, high = np.quantile(resampled, (tail, 1.0 - tail))
    return float(low), float(high)
