"""Samples: one value an episode, all of them there, and pairs on the same episodes."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...agents.errors import InputError

FloatArray = NDArray[np.float64]
Interval = tuple[float, float]


def sample(name: str, values: ArrayLike) -> FloatArray:
    """Return the values of the episodes as an array, shape (n,).

    Raises
    ------
    InputError
        If there are none, they are not one number an episode, or one is missing; the message
        calls them ``name``.
    """
    x = np.asarray(values, dtype=np.float64)
    if x.ndim != 1 or x.size == 0:
        raise InputError(f"{name} has shape {x.shape}; it must be one value an episode, (n,)")
    if not np.isfinite(x).all():
        raise InputError(
            f"{name} of episode {np.isfinite(x).argmin()} is missing; leave such episodes out"
        )
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
