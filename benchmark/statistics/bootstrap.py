"""Confidence intervals, by a bootstrap within the strata of a suite."""

from collections.abc import Callable, Hashable, Iterable
from statistics import NormalDist
from typing import Any

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.statistics.samples import (
    FloatArray,
    Interval,
    Members,
    expanded,
    members_of,
    resampled,
    sample,
)
from numpy.typing import ArrayLike


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

    Each resample draws the episodes of every stratum anew, with replacement, from that stratum. The
    interval is Hesterberg's expanded percentile interval: the quantiles :math:`q` and
    :math:`1 - q` of the resampled statistic with

    .. math:: q = \Phi\left(-\sqrt{\tfrac{n}{n - c}} \; t_{(1 + \text{confidence}) / 2, \, n - c}
        \right)

    for n episodes in c strata of two or more. Resampling m episodes understates their variance by
    (m - 1) / m; the factor corrects that exactly for the mean over strata of one size or one
    variance. In simulations of 4 to 20 strata of 3 to 15 episodes, 95 % intervals of the mean
    covered 94 to 96 % for normal values. For moderately skewed ones (log-normal, sigma 0.5) they
    covered 93 to 94 %, but 90 to 92 % in four or five strata of three; for strongly skewed ones
    (sigma 1) 89 to 93 %, and 84 to 88 % in five strata of two. With the errors of the human-human
    baseline and of ``copy`` on the standard suite they covered 94 to 95 %; with draws as in
    ``quick-v1``, three in each of four strata of which one varies most, 89 to 93 %. The plain
    percentile interval covers 86 to 88 % in strata of three.

    A stratum of one episode cannot vary: it is kept as it is and adds no width, so the interval of
    a suite with one seed has no width and no meaning.

    Parameters
    ----------
    values
        One value per episode, shape (n,).
    strata
        The stratum of each episode, for example ``(subject, behaviour)``; n of them.
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
    members = members_of(strata, x.size)
    found = resampled(lambda drawn: statistic(x[drawn], axis=-1), members, resamples, seed)
    return expanded_percentile(found, members, confidence)


def expanded_percentile(found: FloatArray, members: Members, confidence: float) -> Interval:
    """Return Hesterberg's expanded percentile interval of a resampled statistic, shape (n,).

    Raises
    ------
    InputError
        If the confidence is not between 0 and 1.
    """
    if not 0.0 < confidence < 1.0:
        raise InputError(f"confidence is {confidence}; it must lie between 0 and 1, such as 0.95")
    z = NormalDist().inv_cdf((1.0 + confidence) / 2.0)
    tail = NormalDist().cdf(-expanded(z, members))
    low, high = np.quantile(found, (tail, 1.0 - tail))
    return float(low), float(high)
