"""The robot's seat in the twin for a learner: its inputs, its correction of a line, its reward.

The inputs and the line are those of :mod:`.network.policy`, in JAX and for many lifts at a time:
learning begins with a robot that follows the human.
"""

from typing import Final, NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.submissions.network.policy import CORRECTION, FIXED, LEAD, scales
from colift.benchmark.environment.rewards import UNIT
from colift.benchmark.episode.metrics import FAILED_FRAME_MM
from colift.benchmark.twin.playing import Frames

WORST: Final = (FAILED_FRAME_MM / 1000) ** 2
"""Largest square height difference that is counted [m2]: the twin's table is never dropped."""


class PastSenses(NamedTuple):
    """The past of n lifts; the counterpart of :class:`.network.policy.Senses`."""

    seen: jax.Array
    """(steps, n) heights of the human's end, newest first [m]."""
    commands: jax.Array
    """(3, n) hand commands, newest first [m]."""


def nothing_sensed(steps: int, count: int) -> PastSenses:
    """Return the past of ``count`` lifts that have not begun, for inputs of ``steps`` steps."""
    return PastSenses(jnp.zeros((steps, count)), jnp.zeros((3, count)))


def sense(senses: PastSenses, view: jax.Array, first: jax.Array) -> tuple[PastSenses, jax.Array]:
    """Return the past after one more observation, and the inputs [m].

    Parameters
    ----------
    senses
        The past.
    view
        (5, n) observations of the robot.
    first
        Whether it is the first observation of the lifts: before it, everything stood still.

    Returns
    -------
    tuple
        The past, and the inputs (n, 7 + steps).
    """
    human, end, hand, command, _ = view
    seen = jnp.where(first, human, senses.seen)
    commands = jnp.where(first, command, senses.commands)
    seen, commands = jnp.vstack((human, seen)), jnp.vstack((command, commands))
    now = jnp.stack((human, command - human, hand - command, end - human))
    inputs = jnp.concatenate((now, commands[:-1] - commands[1:], seen[:-1] - seen[1:]))
    return PastSenses(seen[:-1], commands[:-1]), inputs.T


def scaled(metres: jax.Array) -> jax.Array:
    """Return the inputs (n, 7 + steps), scaled for the network."""
    return metres / jnp.asarray(scales(metres.shape[1] - FIXED), jnp.float32)


def change(metres: jax.Array, action: jax.Array) -> jax.Array:
    """Return the change of the hand command (n,) [m]: the line, corrected by an action (n,)."""
    line = LEAD * metres[:, FIXED] - metres[:, 1]
    return line + CORRECTION * jnp.tanh(action)


def reward(frames: Frames) -> jax.Array:
    """Return minus the mean square height difference over a step (n,) [cm2]."""
    square = jnp.minimum((frames.human_end - frames.robot_end) ** 2, WORST).mean(axis=0)
    return -square / UNIT
