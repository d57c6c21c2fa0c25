"""The common part of a step of lifts with touch: sensors, the hand of the person, and commands."""

from typing import Any, Protocol, cast

import jax
import jax.numpy as jnp
from colift.agents.actions import action_limit
from colift.agents.agent import FRAME
from colift.agents.humans.hand import HandMemory, HandNoise, move_hand
from colift.benchmark.twin.body import Body, delayed
from colift.benchmark.twin.functions import LIFTS
from colift.benchmark.twin.haptic_plant import HapticPlant
from colift.benchmark.twin.playing import ramp
from colift.robots.nao.kinematics import STROKE


class HandState(Protocol):
    """The part of a state that moves the hand of the person."""

    @property
    def hand(self) -> HandMemory[jax.Array]:
        """The hand's memory; all (n,)."""

    @property
    def haptic(self) -> HapticPlant:
        """The lifts."""

    @property
    def targets(self) -> jax.Array:
        """(DEPTH, n) history of the intended height [m], newest first."""


class NoiseDue(Protocol):
    """A step's share of the hand's noise; both (f, n)."""

    @property
    def gain(self) -> jax.Array:
        """Noise relative to the velocity."""

    @property
    def tremor(self) -> jax.Array:
        """Tremor [m]."""


def hands_at_rest(count: int) -> HandMemory[jax.Array]:
    """Return the memories of n hands at the beginning of a lift."""
    zero = jnp.zeros(count)
    return HandMemory(zero, zero, zero)


def sensed_by_hands(
    haptic: HapticPlant,
    command: jax.Array,
    time: jax.Array,
    noise: jax.Array,
    latency: jax.Array,
) -> Any:
    """Return the robot's observations (7, n), laid out as :class:`.HapticObservation`.

    Parameters
    ----------
    haptic
        The lifts.
    command
        (n,) command of the far hands [m].
    time
        () time since the lifts began [s].
    noise
        (4, n) error of the sensors.
    latency
        (n,) age of the motion capture's sample in frames.
    """
    plant = haptic.plant
    (human_end,) = delayed(plant.heights, latency, 1)
    robot_end = human_end + delayed(plant.differences, latency, 1)[0]
    force, torque = haptic.touch.mean(axis=0)
    return jnp.stack(
        (
            human_end + noise[0],
            robot_end + noise[1],
            plant.hand,
            command,
            jnp.full_like(human_end, time),
            force + noise[2],
            torque + noise[3],
        )
    )


def moved_hand(
    state: HandState, targets: jax.Array, body: Body, noise: NoiseDue
) -> tuple[HandMemory[jax.Array], jax.Array]:
    """Return the hands after a step, and the heights that the arms pull towards in it (f, n) [m].

    Parameters
    ----------
    state
        The lifts before the step.
    targets
        (f, n) intended height in each frame [m].
    body
        The people.
    noise
        The step's share of the hand's noise.
    """
    heights = state.haptic.plant.heights
    missing = (delayed(state.targets, body.seen, 1) - delayed(heights, body.seen, 1))[0]
    drawn, columns = HandNoise(noise.gain, noise.tremor), cast(Any, targets)
    hand, references = move_hand(LIFTS, state.hand, missing, columns, drawn)
    return hand, cast(jax.Array, references)


def commanded(command: jax.Array, action: jax.Array, size: int) -> jax.Array:
    """Return the commands (f, n) [m] in a step, clipped to the hands' speed and stroke."""
    limit = action_limit(size * FRAME)
    after = jnp.clip(command + jnp.clip(action, -limit, limit), *STROKE)
    return ramp(command, after, size)
