"""People of the twin who have learned to add to what their hands do by themselves."""

from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp
from colift.benchmark.twin.body import Body, delayed
from colift.benchmark.twin.commands import ramp
from colift.benchmark.twin.plant import Plant
from colift.benchmark.twin.policy import Policy

ADDED_HEIGHT: Final = 0.02
"""Largest addition of a learning person to the height of the hands [m]."""

ADDED_PITCH: Final = 0.1
"""Largest addition of a learning person to the pitch that the wrists turn to [rad]."""

SENSES: Final = 3
"""Number of values that :func:`person_senses` returns."""


class LearningPerson(NamedTuple):
    """A person at the near end who has learned to add to what the hands do by themselves."""

    policy: Policy
    """Returns memory and additions (2, n), each of at most 1, for a memory and the senses and
    knowledge of n people, (k, n) of the order of 1."""
    memory: Any
    """The memory at the beginning."""


class Added(NamedTuple):
    """Additions of learning people in the frames of a step, both (f, n)."""

    height: jax.Array
    """Addition to the height of the hands [m]."""
    pitch: jax.Array
    """Addition to the pitch that the wrists turn to [rad]."""


def added_in_step(before: jax.Array, after: jax.Array, size: int) -> Added:
    """Return the additions in ``size`` frames, from those (2, n) before the step to those after."""
    height, pitch = (ramp(a, b, size) for a, b in zip(before, after, strict=True))
    return Added(ADDED_HEIGHT * height, ADDED_PITCH * pitch)


def person_senses(plant: Plant, body: Body) -> jax.Array:
    """Return the senses of n people (3, n), with their delays, of the order of 1.

    The rows are the seen height of their end, the seen difference of the far one, and the felt
    force.
    """
    (height,) = delayed(plant.heights, body.seen, 1)
    (difference,) = delayed(plant.differences, body.seen, 1)
    (force,) = delayed(plant.forces, body.felt, 1)
    return jnp.stack((10.0 * height, 20.0 * difference, 0.5 * force))
