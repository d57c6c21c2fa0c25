"""Products of matrices and functions of arrays with the same bits on every processor.

NumPy's ``@`` uses BLAS, which chooses its code, and with it the order of a sum, by processor,
environment variables and threads; NumPy's ``exp`` and ``arccos`` choose their code by vector
extensions. Here each product and each sum is rounded separately in a fixed order, and each function
is the C library's.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def dot(a: Array, b: Array) -> Array:
    """Return the sum of products over the last axis, of arrays that broadcast to each other.

    A matrix (..., n, k) times a vector (k,) is ``dot(matrix, vector)``, of shape (..., n).
    """
    return np.asarray((a * b).sum(axis=-1))


def matmul(a: Array, b: Array) -> Array:
    """Return the product of matrices (..., n, k) and (..., k, m), of shape (..., n, m)."""
    return np.asarray((a[..., :, :, np.newaxis] * b[..., np.newaxis, :, :]).sum(axis=-2))


def each(function: Callable[[float], float], values: ArrayLike) -> Array:
    """Return the values of a function of :mod:`math`, applied to each value, in their shape."""
    x = np.asarray(values, dtype=np.float64)
    return np.array([function(value) for value in x.ravel().tolist()]).reshape(x.shape)
