"""The common part of a step of lifts with touch: sensors, the hand of the person, and commands."""

from typing import Any, NamedTuple, Protocol

import jax
import jax.numpy as jnp
from colift.agents.actions import action_limit
from colift.agents.agent import FRAME
from colift.agents.humans.scripted import CORRECTION_GAIN, CORRECTION_LIMIT
from colift.benchmark.twin.body import Body, delayed
from colift.benchmark.twin.haptic_lifts import KEPT
from colift.benchmark.twin.haptic_plant import HapticPlant
from colift.benchmark.twin.playing import ramp
from colift.robots.nao.kinematics import STROKE


class HandState(Protocol):
    """State of the hand before a step."""

    @property
    def correction(self) -> jax.Array:
        """(n,) the voluntary correction [m]."""

    @property
    def error(self) -> jax.Array:
        """(n,) error of the hand by motor noise [m]."""

    @property
    def targets(self) -> jax.Array:
        """(DEPTH, n) history of the intended height [m], newest first."""


class HandNoise(Protocol):
    """A step's share of the hand's noise; both (f, n)."""

    @property
    def gain(self) -> jax.Array:
        """Noise relative to the velocity."""

    @property
    def tremor(self) -> jax.Array:
        """Tremor [m]."""


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


def corrected_by_sight(
    correction: jax.Array, targets: jax.Array, heights: jax.Array, body: Body, size: int
) -> jax.Array:
    """Return the voluntary correction (n,) [m] at the end of a step; see :class:`.ScriptedHuman`.

    Parameters
    ----------
    correction
        (n,) correction before the step [m].
    targets, heights
        (DEPTH, n) histories of the intended height and of the height [m], newest first.
    body
        The people.
    size
        Frames of a step.
    """
    missing = (delayed(targets, body.seen, 1) - delayed(heights, body.seen, 1))[0]
    wanted = correction + CORRECTION_GAIN * missing * size * FRAME
    return jnp.clip(wanted, -CORRECTION_LIMIT, CORRECTION_LIMIT)


def noise_of_motion(
    error: jax.Array, gain: jax.Array, before: jax.Array, targets: jax.Array
) -> jax.Array:
    """Return the error of the hand by motor noise (f, n) [m] in each frame of a step.

    Parameters
    ----------
    error
        (n,) error in the last frame [m].
    gain
        (f, n) noise relative to the velocity.
    before, targets
        (n,) intended height in the last frame, and (f, n) in those of the step [m].
    """
    changes = jnp.diff(jnp.concatenate((before[jnp.newaxis], targets)), axis=0)

    def erring(error: jax.Array, due: tuple[jax.Array, jax.Array]) -> tuple[jax.Array, jax.Array]:
        error = KEPT * error + due[0] * due[1]
        return error, error

    return jax.lax.scan(erring, error, (gain, changes))[1]


class MovedHand(NamedTuple):
    """The person's hand in a step."""

    references: jax.Array
    """(f, n) heights that the arms pull towards in each frame [m], not yet clipped to their
    range."""
    correction: jax.Array
    """(n,) the voluntary correction at the end [m]."""
    error: jax.Array
    """(n,) the error by motor noise at the end [m]."""


def moved_hand(
    state: HandState, targets: jax.Array, heights: jax.Array, body: Body, noise: HandNoise
) -> MovedHand:
    """Return the hand in a step of targets (f, n) [m], with noise and correction.

    Parameters
    ----------
    state
        The lifts before the step.
    targets
        Intended height in each frame [m].
    heights
        (DEPTH, n) history of the height [m], newest first.
    body
        The people.
    noise
        The step's share of the hand's noise.
    """
    size = len(targets)
    correction = corrected_by_sight(state.correction, state.targets, heights, body, size)
    errors = noise_of_motion(state.error, noise.gain, state.targets[0], targets)
    ramped = ramp(state.correction, correction, size)
    return MovedHand(targets + errors + noise.tremor + ramped, correction, errors[-1])


def commanded(command: jax.Array, action: jax.Array, size: int) -> jax.Array:
    """Return the commands (f, n) [m] in a step, clipped to the hands' speed and stroke."""
    limit = action_limit(size * FRAME)
    after = jnp.clip(command + jnp.clip(action, -limit, limit), *STROKE)
    return ramp(command, after, size)
