"""Series and parameters of many lifts at a time, as rules read them."""

from collections.abc import Sequence
from typing import Any, NamedTuple, TypeVar

import jax
import jax.numpy as jnp

Record = TypeVar("Record", bound=tuple[Any, ...])


class LiftSeries(NamedTuple):
    """A series of each of n lifts; see :class:`.Series`."""

    values: jax.Array
    """(T + 2, n): 0, then the values, the last one twice."""

    @classmethod
    def of(cls, values: jax.Array) -> "LiftSeries":
        """Return the series of an array (T, n)."""
        return cls(jnp.concatenate((jnp.zeros_like(values[:1]), values, values[-1:])))

    def pair(self, index: Any, /) -> tuple[jax.Array, jax.Array]:
        """Return the numbers (..., n) of frames (..., n), -1 or later, and of the next ones."""
        places = jax.lax.stop_gradient(index).astype(jnp.int32) + 1
        rows = places.reshape(-1, places.shape[-1])
        before, after = (
            jnp.take_along_axis(self.values, rows + ahead, axis=0).reshape(places.shape)
            for ahead in (0, 1)
        )
        return before, after

    def at(self, frame: Any, /) -> jax.Array:
        """Return the numbers (n,) of a frame (), or of a frame (n,) in each lift."""
        place = jnp.clip(frame + 1, 0, len(self.values) - 1)
        if jnp.ndim(place) == 0:
            return jnp.asarray(jax.lax.dynamic_index_in_dim(self.values, place, keepdims=False))
        return jnp.take_along_axis(self.values, place[jnp.newaxis], axis=0)[0]

    def next(self, frame: Any, frames: int, /) -> jax.Array:
        """Return the numbers (frames, n) of frames from ``frame`` on: () or, in each lift, (n,)."""
        if jnp.ndim(frame) == 0:
            return jnp.asarray(jax.lax.dynamic_slice_in_dim(self.values, frame + 1, frames))
        rows = frame + 1 + jnp.arange(frames)[:, jnp.newaxis]
        return jnp.take_along_axis(self.values, jnp.minimum(rows, len(self.values) - 1), axis=0)

    @property
    def last(self) -> int:
        """Index of the last frame."""
        return len(self.values) - 3

    @property
    def own(self) -> jax.Array:
        """The values (T, n)."""
        return self.values[1:-1]


def columns(records: Sequence[Record]) -> Any:
    """Return one record of arrays (n,), in single precision, from n named tuples of numbers."""
    return jax.tree.map(lambda *numbers: jnp.asarray(numbers, float), *records)
