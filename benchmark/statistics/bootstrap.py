"""The bootstrap by people, for statistics without a formula for their standard error."""

import math
from statistics import NormalDist

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.statistics.samples import FloatArray, Interval
from colift.benchmark.statistics.student import t_quantile
from colift.benchmark.statistics.units import Units
from numpy.typing import NDArray


def resampled_weights(units: Units, resamples: int, seed: int) -> FloatArray:
    """Return how often each unit is in each resample, shape (resamples, k).

    The units of each group are drawn anew from that group, with replacement.
    """
    rng = np.random.default_rng(seed)
    weights = np.zeros((resamples, units.count))
    for group in range(int(units.group.max()) + 1):
        members = np.flatnonzero(units.group == group)
        share = np.full(members.size, 1.0 / members.size)
        weights[:, members] = rng.multinomial(members.size, share, resamples)
    return weights


def resampled_means(values: FloatArray, units: Units, weights: FloatArray) -> FloatArray:
    """Return the mean of the values in each resample, shape (..., resamples).

    Parameters
    ----------
    values
        One value per episode, shape (..., n).
    units
        The people of these episodes.
    weights
        Resamples of :func:`resampled_weights`.
    """
    total: NDArray[np.float64] = units.sums(values) @ weights.T
    return total / (weights @ units.sizes)


def expansion(units: Units, confidence: float = 0.95) -> float:
    """Return the normal deviate whose quantiles are the ends of an expanded interval.

    See :func:`expanded_percentile`; it is larger, the fewer the units. There are at least two.
    """
    quantile = t_quantile((1.0 + confidence) / 2.0, units.freedom)
    return quantile * math.sqrt(units.count / units.freedom)


def expanded_percentile(
    found: FloatArray, units: Units, confidence: float = 0.95
) -> Interval | None:
    r"""Return Hesterberg's expanded percentile interval of a resampled statistic, shape (n,).

    The interval is that of the quantiles :math:`q` and :math:`1 - q` with

    .. math:: q = \Phi\left(-\sqrt{\tfrac{k}{k - c}} \; t_{(1 + \text{confidence}) / 2, \, k - c}
        \right)

    for k units in c groups: the root corrects the variance of a resample, which is too small by
    (m - 1) / m in a group of m units, and Student's t accounts for the uncertainty of that variance
    (Hesterberg 2015). A resample cannot leave the range of the units: of fewer than about ten, the
    interval is too narrow. Of a single unit there is none.

    Raises
    ------
    InputError
        If the confidence is not between 0 and 1.
    """
    if not 0.0 < confidence < 1.0:
        raise InputError(f"confidence is {confidence}; it must lie between 0 and 1, such as 0.95")
    if units.freedom == 0:
        return None
    tail = NormalDist().cdf(-expansion(units, confidence))
    low, high = np.quantile(found, (tail, 1.0 - tail))
    return float(low), float(high)
