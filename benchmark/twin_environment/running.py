"""The score of lifts while they are played, so that its changes can be rewards."""

from collections.abc import Sequence
from typing import Final, NamedTuple

import jax
import jax.numpy as jnp
from colift.benchmark.tasks.running_score import known_squares
from colift.benchmark.tasks.touch import held
from colift.benchmark.twin.functions import LIFTS
from colift.benchmark.twin.lifts import Lifts
from colift.benchmark.twin.task_twin import TaskTwin

FAR: Final = 1e4
"""Square distance from a place to be held, before there was one [m2]."""


class Running(NamedTuple):
    """What was missed so far in n lifts, for each number of :attr:`.TaskTwin.stays`."""

    gathered: tuple[jax.Array, ...]
    """Sums of squares (n,), or the least mean square over a stay (n,) [m2]."""
    recent: tuple[jax.Array, ...]
    """The squares of the frames before, for the stays that go on: (stay - 1, n); else (0, n)."""


def nothing_missed(twin: TaskTwin, count: int) -> Running:
    """Return what was missed before the first step."""
    return Running(
        tuple(jnp.full(count, FAR if stay else 0.0) for stay in twin.stays),
        tuple(jnp.full((max(stay - 1, 0), count), FAR) for stay in twin.stays),
    )


def with_step(twin: TaskTwin, running: Running, squares: Sequence[jax.Array]) -> Running:
    """Return what was missed after a step with squares (f, n) [m2]."""
    gathered, recent = [], []
    for stay, sum_or_least, before, new in zip(twin.stays, *running, squares, strict=True):
        if stay:
            frames = jnp.concatenate((before, new))
            gathered.append(jnp.minimum(sum_or_least, held(frames, stay).min(axis=0)))
            recent.append(frames[len(new) :])
        else:
            gathered.append(sum_or_least + new.sum(axis=0))
            recent.append(before)
    return Running(tuple(gathered), tuple(recent))


def square_so_far(twin: TaskTwin, running: Running, lifts: Lifts) -> jax.Array:
    """Return the part of the square of the score that is known (n,) [m2]."""
    known = known_squares(LIFTS, running.gathered, twin.stays)
    return twin.error(lifts, known, lifts.steps * lifts.frames)
