"""Array functions with the same bits on every processor, by the names that networks use."""

import math
from typing import Any, Final, Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class ArrayFunctions(Protocol):
    """The functions of arrays that a network needs, from any library."""

    def product(self, matrix: Any, vector: Any) -> Any:
        """Return a matrix (m, k) times a vector (k,), or times many as columns (k, n)."""

    def tanh(self, values: Any) -> Any:
        """Return the hyperbolic tangent of each value."""

    def stack(self, values: Any) -> Any:
        """Return numbers, or equal arrays, stacked along a new first axis."""

    def join(self, values: Any) -> Any:
        """Return arrays joined along the first axis."""


class PortableFunctions:
    """NumPy without BLAS and without vector extensions, for one vector at a time.

    BLAS chooses the order of a sum by processor and threads, NumPy its ``tanh`` by vector
    extensions. Here each product and sum is rounded by itself in one order, and the function is
    the C library's.
    """

    def product(self, matrix: Array, vector: Array) -> Array:
        """Return a matrix (m, k) times a vector (k,)."""
        return np.asarray((matrix * vector).sum(axis=-1))

    def tanh(self, values: Array) -> Array:
        """Return the hyperbolic tangent of each value (n,)."""
        return np.array([math.tanh(value) for value in values.tolist()])

    def stack(self, values: Any) -> Array:
        """Return numbers as an array."""
        return np.array(values, dtype=np.float64)

    def join(self, values: Any) -> Array:
        """Return arrays in one."""
        return np.concatenate(values)


PORTABLE: Final = PortableFunctions()
