"""Intervals by leaving out one person, policy or pair at a time (Tukey's jackknife).

References
----------
B. Efron, C. Stein (1981). The jackknife estimate of variance. The Annals of Statistics
9(3):586-596.

F. E. Satterthwaite (1946). An approximate distribution of estimates of variance components.
Biometrics Bulletin 2(6):110-114.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.statistics import FloatArray, Interval
from colift.benchmark.statistics.student import t_quantile
from numpy.typing import ArrayLike


class Spread(NamedTuple):
    """The standard error of a figure, and its degrees of freedom."""

    error: float
    dof: int

    def around(self, figure: float, tail: float = 0.025) -> Interval:
        """Return the interval about a figure that misses with the probability ``tail`` a side."""
        reach = t_quantile(1.0 - tail, self.dof) * self.error
        return figure - reach, figure + reach


def spread(*left_out: ArrayLike) -> Spread:
    r"""Return the spread of a figure, from its values without one member at a time.

    With the values :math:`f_{(i)}` without each of n members, the variance is

    .. math:: \frac{n - 1}{n} \sum_i (f_{(i)} - \bar f)^2

    with n - 1 degrees of freedom. The variances of several samples, such as people and policies,
    are added, with Satterthwaite's degrees of freedom.

    Parameters
    ----------
    left_out
        The values of each sample, each of shape (n,).

    Raises
    ------
    InputError
        If a sample has fewer than two members.
    """
    variances, dofs = [], []
    for values in map(np.asarray, left_out):
        count = values.size
        if count < 2:
            raise InputError(f"an interval needs 2 members of a sample or more, got {count}")
        deviations: FloatArray = values - values.mean()
        variances.append((count - 1) / count * float((deviations**2).sum()))
        dofs.append(count - 1)
    return Spread(math.sqrt(sum(variances)), _joint(variances, dofs))


def _joint(variances: Sequence[float], dofs: Sequence[int]) -> int:
    """Return the degrees of freedom of a sum of variances, rounded down."""
    parts = sum(variance**2 / dof for variance, dof in zip(variances, dofs, strict=True))
    return int(sum(variances) ** 2 / parts + 1e-9) if parts > 0 else min(dofs)


def ratio_interval(ratio: float, left_out: ArrayLike, tail: float = 0.025) -> Interval:
    """Return the interval of a positive ratio, symmetric in its logarithm."""
    low, high = spread(np.log(left_out)).around(math.log(ratio), tail)
    return math.exp(low), math.exp(high)
