"""Averages that remain meaningful if some lifts fail or have no value."""

from dataclasses import dataclass
from typing import overload

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.statistics.samples import FloatArray
from numpy.typing import ArrayLike


@dataclass(frozen=True, kw_only=True)
class MeanWithMissing:
    """Mean of a metric that some episodes do not have."""

    mean: float | None
    """Mean over the episodes that have a value; None if none has."""
    missing: int
    """Number of episodes without a value; a ranking goes by this first."""


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
        Axis along which it is computed; by default over all values.

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
        One value per episode, shape (n,); NaN (or None) where there is none.

    Returns
    -------
    MeanWithMissing
        Mean and count of missing values.
    """
    x = np.asarray(values, dtype=np.float64)
    present = x[~np.isnan(x)]
    mean = float(present.mean()) if present.size else None
    return MeanWithMissing(mean=mean, missing=x.size - present.size)
