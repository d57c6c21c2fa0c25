"""The functions of rules for many lifts at a time: those of :mod:`jax.numpy`, and a scan."""

from collections.abc import Callable, Sequence
from typing import Any, Final

import jax
import jax.numpy as jnp


class LiftFunctions:
    """The functions for arrays with one number for each lift; see :class:`.ArrayFunctions`."""

    def __getattr__(self, name: str) -> Any:
        """Return a function of :mod:`jax.numpy`."""
        return getattr(jnp, name)

    def fixed(self, x: jax.Array, /) -> jax.Array:
        """Return ``x``, as a constant for gradients."""
        return jax.lax.stop_gradient(x)

    def row(self, values: Sequence[Any], like: jax.Array, /) -> jax.Array:
        """Return some numbers as an array (k, n)."""
        return jnp.stack([jnp.broadcast_to(value, like.shape) for value in values])

    def each(self, function: Callable[..., Any], /, *rows: jax.Array) -> Any:
        """Return the function's values (k, n)."""
        return function(*rows)

    def column(self, values: Sequence[Any], /) -> jax.Array:
        """Return numbers of successive frames as an array (frames, n)."""
        return jnp.stack(tuple(values))

    def along(self, function: Callable[..., Any], column: jax.Array, /) -> Any:
        """Return the function's record of columns (frames, n)."""
        return function(column)

    def total(self, row: jax.Array, /) -> jax.Array:
        """Return the sum of a row's numbers (n,)."""
        return row.sum(axis=0)

    def least(self, row: jax.Array, /) -> jax.Array:
        """Return the smallest of a row's numbers (n,)."""
        return row.min(axis=0)

    def frames(
        self, step: Callable[..., Any], memory: Any, columns: tuple[Any, ...], /
    ) -> tuple[Any, Any]:
        """Return the memory after some frames, and the output of each, from columns (f, n)."""
        return jax.lax.scan(step, memory, columns)


LIFTS: Final = LiftFunctions()
