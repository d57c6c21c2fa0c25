"""Lifts on the device, from which an environment takes what is due at a time."""

from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.rules import Drawn
from colift.benchmark.twin.columns import LiftSeries
from colift.benchmark.twin.lifts import Lifts, Share, shares


class LaneSeries(NamedTuple):
    """A series of each of n lifts of a pool; see :class:`.Series`."""

    table: jax.Array
    """(p, T + 2) the values of :class:`.LiftSeries`, lift by lift."""
    lane: jax.Array
    """(n,) the lifts."""

    def pair(self, index: Any, /) -> tuple[jax.Array, jax.Array]:
        """Return the numbers (..., n) of frames (..., n), -1 or later, and of the next ones."""
        place = jax.lax.stop_gradient(index).astype(jnp.int32) + 1
        return self.table[self.lane, place], self.table[self.lane, place + 1]

    def at(self, frame: Any, /) -> jax.Array:
        """Return the numbers (n,) of a frame (n,) in each lift."""
        return self.table[self.lane, jnp.clip(frame + 1, 0, self.table.shape[1] - 1)]

    def next(self, frame: Any, frames: int, /) -> jax.Array:
        """Return the numbers (frames, n) of some frames, of which ``frame`` (n,) is the first."""

        def one(lane: jax.Array, first: jax.Array) -> jax.Array:
            return jax.lax.dynamic_slice(self.table, (lane, first), (1, frames))[0]

        return jax.vmap(one, out_axes=1)(self.lane, frame + 1)

    @property
    def last(self) -> int:
        """Index of the last frame."""
        return self.table.shape[1] - 3


class Table(NamedTuple):
    """A tree of arrays (..., p) as rows, so that what a lift needs at a time is in one place."""

    rows: jax.Array
    """(p, ..., w)"""
    tree: Callable[[jax.Array], Any]
    """Returns the tree of rows (n, w), with leaves (..., n)."""


def table_of(tree: Any, lead: int = 0) -> Table:
    """Return the table of a tree whose leaves have ``lead`` common axes, some more, and p lifts."""
    leaves, shape = jax.tree.flatten(tree)
    kinds = [leaf.dtype for leaf in leaves]
    inner = [leaf.shape[lead:-1] for leaf in leaves]
    ends = np.cumsum([0, *(int(np.prod(each)) for each in inner)]).tolist()
    moved = [jnp.moveaxis(jnp.asarray(leaf, float), -1, 0) for leaf in leaves]
    rows = [each.reshape(*each.shape[: lead + 1], -1) for each in moved]

    def back(found: jax.Array) -> Any:
        columns = found.T
        parts = [
            columns[first:last].reshape(*form, -1).astype(kind)
            for first, last, form, kind in zip(ends, ends[1:], inner, kinds, strict=False)
        ]
        return jax.tree.unflatten(shape, parts)

    return Table(jnp.concatenate(rows, axis=-1), back)


class LiftPool:
    """Drawn lifts, each of which may be played at any time.

    Parameters
    ----------
    lifts
        p lifts.
    """

    def __init__(self, lifts: Lifts) -> None:
        self.size, self.frames, self.longest = lifts.size, lifts.frames, lifts.longest
        self.numbers = lifts.errors.shape[1]
        """Numbers of the robot's observation."""
        self._due = table_of(shares(lifts), lead=1)
        drawn = lifts.drawn
        self._plans = jax.tree.map(
            lambda series: series.values.T,
            (drawn.target, drawn.series, drawn.chance),
            is_leaf=lambda each: isinstance(each, LiftSeries),
        )
        self._fixed = table_of(
            (drawn.facts, drawn.manner, lifts.hand, lifts.stop, lifts.steps, lifts.body, lifts.arms)
        )

    def lifts(self, lane: jax.Array) -> Lifts:
        """Return n lifts of the pool; their noise is that of no step, see :meth:`share`."""
        facts, manner, hand, stop, steps, body, arms = self._fixed.tree(self._fixed.rows[lane])
        target, series, chance = jax.tree.map(lambda table: LaneSeries(table, lane), self._plans)
        none = jnp.zeros((0, self.frames, len(lane)))
        return Lifts(
            drawn=Drawn(target, series, facts, chance, manner),
            gain=none,
            tremor=none,
            hand=hand,
            errors=none,
            ages=none,
            stop=stop,
            steps=steps,
            body=body,
            arms=arms,
        )

    def share(self, lane: jax.Array, step: jax.Array) -> Share:
        """Return the share of a step (n,) in the noise of n lifts; the last one stays."""
        share: Share = self._due.tree(self._due.rows[lane, jnp.minimum(step, self.longest - 1)])
        return share
