"""Summaries of a suite: interquartile mean and stratified bootstrap confidence intervals.

The cells of a suite (subject x behaviour) are fixed; only the seeds within a cell are a sample. So
episodes are resampled within their cell, never across, and an interval says how far another draw
of seeds would move the number, not how far other people or other behaviours would.

Smoothness is missing (NaN) in episodes in which the robot did not move. Its summary is the mean of
the episodes that have one *and* the count of those that do not: whoever ranks by smoothness ranks
by that count first, so that moving only when it is easy never helps. Intervals take no NaN: leave
out the missing episodes, with their strata, first.

References
----------
T. Hesterberg (2015). What teachers should know about the bootstrap: resampling in the
undergraduate statistics curriculum. The American Statistician 69(4):371-386.

R. Agarwal et al. (2021). Deep reinforcement learning at the edge of the statistical precipice.
NeurIPS 34 (interquartile mean, bootstrap stratified over tasks).
"""

import math
from collections.abc import Callable, Hashable, Iterable
from dataclasses import dataclass
from statistics import NormalDist
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..agents.errors import InputError

FloatArray = NDArray[np.float64]
Interval = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class MeanWithMissing:
    """Mean of a metric that some episodes do not have."""

    mean: float
    """Mean over the episodes that have a value; NaN if none has."""
    missing: int
    """Episodes without a value. Rank by this first."""


@dataclass(frozen=True, kw_only=True)
class PairedDifference:
    """Mean difference of two policies on the same episodes."""

    mean: float
    """Mean of a - b, in the unit of the values."""
    ci95: Interval
    """95 % confidence interval of the mean."""


@overload
def interquartile_mean(values: ArrayLike, axis: None = None) -> float: ...
@overload
def interquartile_mean(values: ArrayLike, axis: int) -> FloatArray: ...
def interquartile_mean(values: ArrayLike, axis: int | None = None) -> float | FloatArray:
    """Return the mean of the middle half of the values.

    Of n sorted values the floor(n / 4) smallest and largest are left out: robust against single
    failures like the median, but it still uses half of the data.

    Parameters
    ----------
    values
        Values, any shape.
    axis
        Axis along which to take it; over all values by default.

    Returns
    -------
    float or array
        Interquartile mean, in the unit of the values.

    Raises
    ------
    InputError
        If there are no values or one is NaN.
    """
    x = np.asarray(values, dtype=np.float64)
    if axis is None:
        return float(interquartile_mean(x.ravel(), -1))
    n = x.shape[axis]
    if n == 0 or np.isnan(x).any():
        raise InputError("the interquartile mean needs at least one value and no NaN")
    cut = n // 4
    parts = np.partition(x, (cut, n - 1 - cut), axis=axis)
    middle: FloatArray = parts.take(range(cut, n - cut), axis=axis).mean(axis=axis)
    return middle


def mean_with_missing(values: ArrayLike) -> MeanWithMissing:
    """Return the mean over the episodes that have a value, and the count of those that do not.

    Parameters
    ----------
    values
        One value an episode, shape (n,); NaN (or None) where there is none.

    Returns
    -------
    MeanWithMissing
        Mean and count of missing values.
    """
    x = np.asarray(values, dtype=np.float64)
    present = x[~np.isnan(x)]
    mean = float(present.mean()) if present.size else math.nan
    return MeanWithMissing(mean=mean, missing=x.size - present.size)


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
    covered 94 to 96 % for normal and 93 to 94 % for moderately skewed values (log-normal, sigma
    0.5), but 89 to 93 % for strongly skewed ones (sigma 1) and 84 to 88 % in five cells of two.
    The plain percentile interval covers 86 to 88 % in cells of three.

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
        :func:`interquartile_mean`.
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
    x = _sample("values", values)
    cells = _cells(strata, x.size)
    drawn = _resample(cells, resamples, seed)
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
    a, b = _paired("numerator", numerator, "denominator", denominator)
    if b.min() <= 0.0:
        raise InputError(f"denominator {b.min()} of episode {b.argmin()} must be positive")
    cells = _cells(strata, a.size)
    drawn = _resample(cells, resamples, seed)
    ratios = a[drawn].mean(axis=-1) / b[drawn].mean(axis=-1)
    return _expanded_percentile(ratios, cells, confidence)


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
    x, y = _paired("a", a, "b", b)
    ci95 = stratified_bootstrap(x - y, strata, resamples=resamples, seed=seed)
    return PairedDifference(mean=float((x - y).mean()), ci95=ci95)


def paired_permutation_p(
    a: ArrayLike, b: ArrayLike, *, resamples: int = 10_000, seed: int = 0
) -> float:
    """Return the two-sided p value of "a and b do not differ", by random sign flips.

    If they did not, each difference a - b would be as likely with the other sign. The p value is
    the share of sign flips, the observed signs among them, whose mean difference is at least as
    far from zero; it is never below 1 / (resamples + 1).

    Parameters
    ----------
    a, b
        Values of two policies on the same episodes in the same order, each of shape (n,).
    resamples
        Number of random sign flips.
    seed
        Seed of the flips: the same inputs give the same p value.

    Returns
    -------
    float
        p value, in (0, 1].

    Raises
    ------
    InputError
        If the values are empty, not finite or of unequal length.
    """
    x, y = _paired("a", a, "b", b)
    difference = x - y
    signs = np.random.default_rng(seed).choice((-1.0, 1.0), (resamples, difference.size))
    # Flips that give the same sum in another order of rounding count as equal.
    least = abs(difference.sum()) - 1e-9 * np.abs(difference).sum()
    extreme = int((np.abs(signs @ difference) >= least).sum())
    return (1 + extreme) / (1 + resamples)


def _cells(strata: Iterable[Hashable], episodes: int) -> list[NDArray[np.intp]]:
    """Return the indices of the episodes of each cell, cells in order of appearance."""
    members: dict[Hashable, list[int]] = {}
    for index, stratum in enumerate(strata):
        members.setdefault(stratum, []).append(index)
    labelled = sum(len(cell) for cell in members.values())
    if labelled != episodes:
        raise InputError(f"strata has {labelled} labels; it must have one for each of {episodes}")
    return [np.array(cell, dtype=np.intp) for cell in members.values()]


def _resample(cells: list[NDArray[np.intp]], resamples: int, seed: int) -> NDArray[np.intp]:
    """Return indices of resampled episodes, shape (resamples, n), drawn cell by cell."""
    rng = np.random.default_rng(seed)
    return np.concatenate([rng.choice(cell, (resamples, cell.size)) for cell in cells], axis=1)


def _expanded_percentile(
    resampled: FloatArray, cells: list[NDArray[np.intp]], confidence: float
) -> Interval:
    if not 0.0 < confidence < 1.0:
        raise InputError(f"confidence is {confidence}; it must lie between 0 and 1, such as 0.95")
    sizes = [cell.size for cell in cells if cell.size > 1]
    dof = sum(sizes) - len(sizes)
    z = NormalDist().inv_cdf((1.0 + confidence) / 2.0)
    expanded = _student_t(z, dof) * math.sqrt(sum(sizes) / dof) if dof else z
    tail = NormalDist().cdf(-expanded)
    low, high = np.quantile(resampled, (tail, 1.0 - tail))
    return float(low), float(high)


def _student_t(z: float, dof: int) -> float:
    """Return Student's t quantile from the normal one (Abramowitz & Stegun 26.7.5)."""
    return z + (z**3 + z) / (4 * dof) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * dof**2)


def _paired(name_a: str, a: ArrayLike, name_b: str, b: ArrayLike) -> tuple[FloatArray, FloatArray]:
    x, y = _sample(name_a, a), _sample(name_b, b)
    if x.size != y.size:
        raise InputError(f"{name_a} has {x.size} episodes, {name_b} {y.size}; pairs are needed")
    return x, y


def _sample(name: str, values: ArrayLike) -> FloatArray:
    x = np.asarray(values, dtype=np.float64)
    if x.ndim != 1 or x.size == 0:
        raise InputError(f"{name} has shape {x.shape}; it must be one value an episode, (n,)")
    if not np.isfinite(x).all():
        raise InputError(
            f"{name} of episode {np.isfinite(x).argmin()} is missing; leave such episodes out"
        )
    return x
