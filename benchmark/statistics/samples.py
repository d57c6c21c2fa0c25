"""Samples: one value per episode, and pairs on the same episodes."""

import numpy as np
from colift.base.errors import InputError
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
Interval = tuple[float, float]


def sample(name: str, values: ArrayLike) -> FloatArray:
    """Return the values of the episodes as an array, shape (n,).

    Raises
    ------
    InputError
        If there are no values, not one number per episode, or one is not finite; the message calls
        them ``name``.
    """
    x = np.asarray(values, dtype=np.float64)
    if x.ndim != 1 or x.size == 0:
        raise InputError(f"{name} has shape {x.shape}; it must be one value per episode, (n,)")
    if not np.isfinite(x).all():
        index = int(np.isfinite(x).argmin())
        raise InputError(f"{name}[{index}] is {x[index]}; it must be a number for each episode")
    return x


def paired(name_a: str, a: ArrayLike, name_b: str, b: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Return two samples of the same episodes, each of shape (n,).

    Raises
    ------
    InputError
        As :func:`sample`, or if they are of unequal length.
    """
    x, y = sample(name_a, a), sample(name_b, b)
    if x.size != y.size:
        raise InputError(f"{name_a} has {x.size} episodes, {name_b} {y.size}; pairs are needed")
    return x, y
