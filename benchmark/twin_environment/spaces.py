"""Spaces of the environment, in the manner of gymnax and JaxMARL."""

from typing import Any

import jax
import jax.numpy as jnp


class Box:
    """Arrays of a shape between bounds.

    Parameters
    ----------
    low, high
        Bounds: numbers, or arrays of the shape.
    shape
        Shape of the arrays.
    dtype
        Their type.
    """

    def __init__(
        self, low: Any, high: Any, shape: tuple[int, ...], dtype: Any = jnp.float32
    ) -> None:
        self.low, self.high, self.shape, self.dtype = low, high, shape, dtype

    def sample(self, key: jax.Array) -> jax.Array:
        """Return a random array, even between the bounds."""
        return jax.random.uniform(key, self.shape, self.dtype, self.low, self.high)

    def contains(self, x: Any) -> jax.Array:
        """Return whether all numbers are within the bounds."""
        return jnp.all((x >= self.low) & (x <= self.high))
