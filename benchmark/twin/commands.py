"""Commands of the far hands over the frames of a step."""

import jax
import jax.numpy as jnp


def ramp(start: jax.Array, stop: jax.Array, size: int) -> jax.Array:
    """Return values (f, n) that move at constant speed from ``start`` to ``stop``, both (n,)."""
    share = jnp.arange(1, size + 1, dtype=float)[:, jnp.newaxis] / size
    return start + (stop - start) * share
