"""A person and a NAO on one table, reduced to one degree of freedom.

The NAO's hands pin the far end at their height h, so that of the table's motion only the height z
of the person's hands is left. With s = (h - z) / L the sine of the pitch, to third order in s,

    (M + m/4 + mu) z'' = K (r - z) + B (r' - z') + (k pitch + d pitch') (1 + s^2/2) / L
                         - (m/4 - mu) h'',        mu = m (1 + s^2) / 12 + (2 M + m/4) s^2.

The step is the engine's: semi-implicit, 10 ms, references and commands taken at its beginning.
"""

from collections.abc import Sequence
from typing import Final, NamedTuple

import jax
import jax.numpy as jnp

from ...agents.agent import FRAME
from ..world.table import (
    GRAVITY,
    GRIP_DAMPING,
    GRIP_STIFFNESS,
    TABLE_INERTIA,
    TABLE_LENGTH,
    TABLE_MASS,
    WEIGHT_SHARE,
)
from .arm import Arm, ArmVariation, drive, rest
from .body import DEPTH, Body, delayed, pushed, reflexes

_IMPLICIT: Final = 1 + FRAME * GRIP_DAMPING / TABLE_INERTIA / 2
_PITCH_GAIN: Final = GRIP_STIFFNESS / _IMPLICIT
_RATE_GAIN: Final = GRIP_DAMPING / _IMPLICIT


class Plant(NamedTuple):
    """The state of n lifts; histories are (DEPTH, n), newest first, all else (n,)."""

    velocity: jax.Array
    """Of the person's end [m/s]."""
    pitch: jax.Array
    """Of the table [rad]."""
    pitch_rate: jax.Array
    """[rad/s]"""
    far_velocity: jax.Array
    """Of the far end [m/s]."""
    far_force: jax.Array
    """Force of the far hands on the table [N]."""
    reference: jax.Array
    """The height that the person's arms pull towards, with the reflex [m]."""
    reflex: jax.Array
    """Shift of the reference by the reflex [m]."""
    arm: Arm
    """The NAO's arms."""
    heights: jax.Array
    """History of the person's end [m]."""
    differences: jax.Array
    """History of the far end's height above the person's [m]."""
    forces: jax.Array
    """History of the force of the person's hands, beyond the share of the weight [N]."""

    @property
    def hand(self) -> jax.Array:
        """Height of the far hands by their encoders [m]."""
        return self.arm.hand


def begin(count: int) -> Plant:
    """Return lifts at rest."""
    zero, past = jnp.zeros(count), jnp.zeros((DEPTH, count))
    weight = jnp.full(count, WEIGHT_SHARE)
    return Plant(
        velocity=zero,
        pitch=zero,
        pitch_rate=zero,
        far_velocity=zero,
        far_force=weight,
        reference=zero,
        reflex=zero,
        arm=rest(count),
        heights=past,
        differences=past,
        forces=past,
    )


def advance(
    plant: Plant,
    body: Body,
    references: Sequence[jax.Array],
    commands: Sequence[jax.Array],
    variation: ArmVariation | None = None,
) -> Plant:
    """Return the lifts some frames later, at most :data:`.CHUNK`.

    Parameters
    ----------
    plant
        The lifts.
    body
        The people.
    references
        For each frame, what the person's arms pull towards at its end, without the reflex [m].
    commands
        For each frame, the commanded height of the far hands at its end [m].
    variation
        Arms that differ from the benchmark's; none: its own.
    """
    count = len(references)
    shifts = reflexes(
        body,
        plant.reflex,
        delayed(plant.differences, body.seen, count),
        delayed(plant.forces, body.felt, count),
    )
    height, far_height = plant.heights[0], plant.heights[0] + plant.differences[0]
    velocity, far_velocity = plant.velocity, plant.far_velocity
    pitch, pitch_rate, far_force = plant.pitch, plant.pitch_rate, plant.far_force
    previous, arm, mass = plant.reference, plant.arm, body.mass
    heights, differences, forces = [], [], []
    for wanted, shift, command in zip(references, shifts, commands, strict=True):
        reference = wanted + shift
        arms = body.stiffness * (previous - height)
        arms = arms + body.damping * ((reference - previous) / FRAME - velocity)
        arm = drive(arm, command, far_force, variation)
        new_far_velocity = (arm.hand - far_height) / FRAME

        square = ((far_height - height) / TABLE_LENGTH) ** 2
        grip = (_PITCH_GAIN * pitch + _RATE_GAIN * pitch_rate) / TABLE_LENGTH * (1 + square / 2)
        tilted = TABLE_MASS / 12 * (1 + square) + (2 * mass + TABLE_MASS / 4) * square
        carried = (TABLE_MASS / 4 - tilted) * (new_far_velocity - far_velocity) / FRAME
        acceleration = (arms + grip - carried) / (mass + TABLE_MASS / 4 + tilted)

        velocity = velocity + FRAME * acceleration
        height = height + FRAME * velocity
        far_height, far_velocity = arm.hand, new_far_velocity
        sine = (far_height - height) / TABLE_LENGTH
        pitch = sine * (1 + sine**2 / 6)
        new_rate = (far_velocity - velocity) / TABLE_LENGTH * (1 + sine**2 / 2)
        centre = acceleration + TABLE_LENGTH / 2 / FRAME * (new_rate - pitch_rate)
        pitch_rate = new_rate
        force = arms - mass * acceleration
        far_force = TABLE_MASS * (GRAVITY + centre) - force - WEIGHT_SHARE

        previous = reference
        heights.append(height)
        differences.append(far_height - height)
        forces.append(force)
    return Plant(
        velocity=velocity,
        pitch=pitch,
        pitch_rate=pitch_rate,
        far_velocity=far_velocity,
        far_force=far_force,
        reference=previous,
        reflex=shifts[-1],
        arm=arm,
        heights=pushed(plant.heights, heights),
        differences=pushed(plant.differences, differences),
        forces=pushed(plant.forces, forces),
    )
