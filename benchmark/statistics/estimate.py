"""Means, ratios and differences of means, each with its 95 % confidence interval.

An interval is Student's t interval between people: a mean of n values in k units and c groups has
the standard error :meth:`.Units.standard_error` and k - c degrees of freedom. Errors are skewed:
where all values are positive, the interval is that of the logarithm of the mean.
"""

import math
from dataclasses import dataclass
from typing import Final, Self

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.statistics.samples import FloatArray, Interval, paired, sample
from colift.benchmark.statistics.student import t_quantile
from colift.benchmark.statistics.superiority import share_better
from colift.benchmark.statistics.units import Units
from colift.robots.arithmetic import each
from numpy.typing import ArrayLike

CONFIDENCE: Final = 0.95
"""Confidence of every interval."""

LEAST: Final = 1e-3
"""Least value in a ratio: smaller ones, and zero, count as this. Of errors it is a micrometre [mm],
far below what any policy or person reaches."""


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """A mean over episodes, or a ratio or difference of such means."""

    mean: float
    ci95: Interval | None
    """95 % confidence interval, for other people from the same population; None if all episodes are
    of one person."""

    @property
    def ends(self) -> Interval:
        """The ends of the interval as a drawing needs them: without one, the mean twice."""
        return self.ci95 or (self.mean, self.mean)

    def rounded(self, places: int) -> "Estimate":
        """Return mean and interval rounded to ``places`` decimals."""
        ends = None if self.ci95 is None else _interval(*(round(end, places) for end in self.ci95))
        return Estimate(mean=round(self.mean, places), ci95=ends)

    def exponential(self) -> "Estimate":
        """Return e to the power of mean and interval: of a mean logarithm, a geometric mean."""
        ends = None if self.ci95 is None else _interval(*map(_exp, self.ci95))
        return Estimate(mean=_exp(self.mean), ci95=ends)


@dataclass(frozen=True, kw_only=True)
class PairedDifference(Estimate):
    """Mean difference of two policies on the same episodes, with its significance."""

    p: float
    """p value for the hypothesis that they do not differ, by sign flips."""
    share_better: float
    """Share of the episodes in which the first is better (smaller), ties counted half."""

    @classmethod
    def of(cls, a: ArrayLike, b: ArrayLike, units: Units, p: float) -> Self:
        """Return the difference a - b; see :func:`paired_difference`."""
        found = paired_difference(a, b, units)
        return cls(mean=found.mean, ci95=found.ci95, p=p, share_better=share_better(a, b))


def mean_of(values: ArrayLike, units: Units) -> Estimate:
    r"""Return the mean with its 95 % interval.

    With mean :math:`m`, standard error :math:`s` and :math:`t = t_{0.975, k - c}`, the interval is
    :math:`m \, e^{\pm t s / m}` if all values are positive, :math:`m \pm t s` otherwise.

    Parameters
    ----------
    values
        One value per episode, shape (n,).
    units
        The people of these episodes.

    Returns
    -------
    Estimate
        Mean and interval, in the unit of the values.

    Raises
    ------
    InputError
        If the values are empty, not finite, or not as many as the units have episodes.
    """
    x = sample("values", values)
    return _relative(x.mean(), x, units) if x.min() > 0.0 else _mean(x, units)


def paired_difference(a: ArrayLike, b: ArrayLike, units: Units) -> Estimate:
    """Return the mean of a - b over the same episodes, with its 95 % interval.

    Parameters
    ----------
    a, b
        Values of two policies on the same episodes in the same order, each of shape (n,).
    units
        The people of these episodes.

    Returns
    -------
    Estimate
        Mean and interval, in the unit of the values.

    Raises
    ------
    InputError
        As :func:`mean_of`, or if the values are of unequal length.
    """
    x, y = paired("a", a, "b", b)
    return _mean(x - y, units)


def log_ratios(numerator: ArrayLike, denominator: ArrayLike) -> FloatArray:
    """Return the logarithm of the ratio in each episode, shape (n,).

    Values below :data:`LEAST` count as this, so that an error of zero has a ratio.

    Raises
    ------
    InputError
        If the values are empty, not finite, negative, or of unequal length.
    """
    a, b = paired("numerator", numerator, "denominator", denominator)
    for name, values in (("numerator", a), ("denominator", b)):
        if values.min() < 0.0:
            where = int(values.argmin())
            raise InputError(f"{name}[{where}] is {values[where]}; a ratio needs errors from 0 on")
    return each(math.log, np.maximum(a, LEAST)) - each(math.log, np.maximum(b, LEAST))


def geometric_ratio(numerator: ArrayLike, denominator: ArrayLike, units: Units) -> Estimate:
    r"""Return the geometric mean of the ratio over the same episodes, with its 95 % interval.

    .. math:: \exp\left(\frac{1}{n} \sum_i \ln \frac{a_i}{b_i}\right)

    Every episode counts alike, be it easy or difficult, and the ratio of b to a is its reciprocal.

    Parameters
    ----------
    numerator, denominator
        Errors in the same episodes in the same order, each of shape (n,).
    units
        The people of these episodes.

    Returns
    -------
    Estimate
        Ratio and interval, dimensionless.

    Raises
    ------
    InputError
        As :func:`log_ratios`.
    """
    return _mean(log_ratios(numerator, denominator), units).exponential()


def ratio_of_means(numerator: ArrayLike, denominator: ArrayLike, units: Units) -> Estimate:
    """Return mean(numerator) / mean(denominator) with its 95 % interval, on the same episodes.

    Parameters
    ----------
    numerator, denominator
        Values of the same episodes in the same order, each of shape (n,); the denominator positive.
    units
        The people of these episodes.

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
    mean = a.mean() / b.mean()
    return _relative(mean, a / b.mean() - mean * b / b.mean(), units)


def difference_of_means(a: ArrayLike, units_a: Units, b: ArrayLike, units_b: Units) -> Estimate:
    r"""Return mean(a) - mean(b), of different people, with its 95 % interval.

    The degrees of freedom are Welch's, rounded down. For the same episodes, use
    :func:`paired_difference`.

    Parameters
    ----------
    a, b
        Values of two sets of episodes, of shapes (n,) and (m,).
    units_a, units_b
        The people of each set; none is in both.

    Returns
    -------
    Estimate
        Difference and interval, in the unit of the values.

    Raises
    ------
    InputError
        As :func:`mean_of`.
    """
    x, y = sample("a", a), sample("b", b)
    mean = float(x.mean() - y.mean())
    errors = units_a.standard_error(x), units_b.standard_error(y)
    if errors[0] is None or errors[1] is None:
        return Estimate(mean=mean, ci95=None)
    one, other = (error**2 for error in errors if error is not None)
    freedom = math.inf
    if one + other > 0.0:
        freedom = (one + other) ** 2 / (one**2 / units_a.freedom + other**2 / units_b.freedom)
    fewest = min(units_a.freedom, units_b.freedom)
    most = units_a.freedom + units_b.freedom
    half = math.sqrt(one + other) * _t(int(min(max(freedom, fewest), most)))
    return Estimate(mean=mean, ci95=_interval(mean - half, mean + half))


def _mean(x: FloatArray, units: Units) -> Estimate:
    """Return the mean with an interval that is symmetric about it."""
    mean, error = float(x.mean()), units.standard_error(x)
    if error is None:
        return Estimate(mean=mean, ci95=None)
    half = _t(units.freedom) * error
    return Estimate(mean=mean, ci95=_interval(mean - half, mean + half))


def _relative(mean: float, x: FloatArray, units: Units) -> Estimate:
    """Return a positive mean with an interval that is symmetric about its logarithm.

    The mean of ``x`` has the mean's standard error.
    """
    mean, error = float(mean), units.standard_error(x)
    if error is None or mean <= 0.0:
        return Estimate(mean=mean, ci95=None if error is None else (mean, mean))
    half = _t(units.freedom) * error / mean
    return Estimate(mean=mean, ci95=_interval(mean * _exp(-half), mean * _exp(half)))


def _t(freedom: int) -> float:
    return t_quantile((1.0 + CONFIDENCE) / 2.0, freedom)


def _exp(value: float) -> float:
    # An interval of two people can be wider than any number.
    return math.exp(min(max(value, -700.0), 700.0))


def _interval(low: float, high: float) -> Interval:
    return low, high
