"""The functions of rules for many lifts at a time: those of :mod:`jax.numpy`, and a scan."""

from collections.abc import Callable, Sequence
from typing import Any, Final

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.agent import FRAME
from colift.agents.senses import LONGEST_EPISODE
from colift.benchmark.twin.inner import each_frame

_LONGEST: Final = round(LONGEST_EPISODE / FRAME)
_TIMES: Final = np.arange(-_LONGEST, _LONGEST + 1) * FRAME


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

    def seconds(self, frames: Any, /) -> jax.Array:
        """Return the time of frames [s], rounded once: rules compare it with decimal numbers."""
        # A table: XLA makes a product of a quotient, which is rounded twice.
        return jnp.asarray(_TIMES, float)[jnp.asarray(frames, int) + _LONGEST]

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
        return each_frame(step, memory, columns)


LIFTS: Final = LiftFunctions()
