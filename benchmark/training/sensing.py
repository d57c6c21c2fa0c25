"""Sensors of lifts to learn from, drawn anew in each batch."""

from typing import Final

import jax
import jax.numpy as jnp
from colift.agents.agent import RobotObservation
from colift.benchmark.twin.body import DEPTH
from colift.benchmark.twin.lifts import Lifts

SEEN: Final = slice(RobotObservation.HUMAN_END, RobotObservation.HAND_HEIGHT)
"""What the motion capture gives."""

OWN: Final = slice(RobotObservation.HAND_HEIGHT, RobotObservation.TIME)
"""Height and command of the robot's hands."""


def with_noise(lifts: Lifts, deviation: jax.Array, key: jax.Array) -> Lifts:
    """Return lifts with other errors of the motion capture, of a standard deviation (n,) [m]."""
    drawn = deviation * jax.random.normal(key, lifts.errors[:, SEEN].shape)
    return lifts._replace(errors=lifts.errors.at[:, SEEN].set(drawn))


def with_own_errors(lifts: Lifts, deviation: float, key: jax.Array) -> Lifts:
    """Return lifts with errors of the robot's own hands, of a standard deviation [m]."""
    drawn = deviation * jax.random.normal(key, lifts.errors[:, OWN].shape)
    return lifts._replace(errors=lifts.errors.at[:, OWN].set(drawn))


def with_losses(lifts: Lifts, chance: jax.Array, key: jax.Array) -> Lifts:
    """Return lifts in which samples are lost by a chance (n,), and the last one is seen again.

    A sample is at most as old as the twin's memory.
    """
    steps = jnp.arange(lifts.longest)[:, jnp.newaxis]
    lost = jax.random.uniform(key, lifts.ages.shape) < chance
    newest = jax.lax.cummax(jnp.where(lost, 0, steps), axis=0)
    ages = jnp.take_along_axis(lifts.ages, newest, axis=0) + lifts.frames * (steps - newest)
    seen = jnp.take_along_axis(lifts.errors[:, SEEN], newest[:, jnp.newaxis], axis=0)
    return lifts._replace(
        ages=jnp.minimum(ages, DEPTH - 1), errors=lifts.errors.at[:, SEEN].set(seen)
    )
