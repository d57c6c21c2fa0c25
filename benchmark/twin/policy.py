"""Policies of the twin: pure functions of a memory and of the observations of n lifts."""

from collections.abc import Callable
from typing import Any, Final

import jax
import jax.numpy as jnp
from colift.agents.control.recurrent import GatedNetwork, Memory, act

Policy = Callable[[Any, jax.Array], tuple[Any, jax.Array]]
"""Returns memory and actions (n,) [m] for a memory and observations (k, n) of its task."""


class JaxFunctions:
    """The array functions of networks in JAX, for many lifts at a time."""

    def product(self, matrix: jax.Array, vector: jax.Array) -> jax.Array:
        """Return a matrix (m, k) times vectors as columns (k, n)."""
        return matrix @ vector

    def tanh(self, values: jax.Array) -> jax.Array:
        """Return the hyperbolic tangent of each value."""
        return jnp.tanh(values)

    def stack(self, values: Any) -> jax.Array:
        """Return arrays stacked along a new first axis."""
        return jnp.stack(values)

    def join(self, values: Any) -> jax.Array:
        """Return arrays joined along the first axis."""
        return jnp.concatenate(values)


JAX: Final = JaxFunctions()


def recurrent(network: GatedNetwork, count: int) -> tuple[Policy, Memory]:
    """Return the policy of a network, and its memory at the beginning of n lifts."""

    def policy(memory: Memory, view: jax.Array) -> tuple[Memory, jax.Array]:
        return act(network, memory, view, JAX)

    zero = jnp.zeros(count)
    return policy, Memory(jnp.zeros((network.units, count)), zero, zero, zero, zero)
