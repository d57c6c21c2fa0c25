"""A person and a NAO on one table, reduced to one degree of freedom.

The NAO's hands pin the far end at their height h, so that the only remaining coordinate of the
table is the height z of the person's hands. With s = (h - z) / L the sine of the pitch, to third
order in s,

    (M + m/4 + mu) z'' = K (r - z) + B (r' - z') + (k pitch + d pitch') (1 + s^2/2) / L
                         - (m/4 - mu) h'',        mu = m (1 + s^2) / 12 + (2 M + m/4) s^2.

The step is the engine's: semi-implicit, 10 ms, references and commands taken at its beginning.
"""

from typing import NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.agent import FRAME
from colift.benchmark.twin.arm import Arm, ArmVariation, arms_at_rest, drive
from colift.benchmark.twin.body import DEPTH, Body, activated, delayed, pushed, wanted_shift
from colift.benchmark.twin.inner import each_frame
from colift.benchmark.world.table import (
    GRAVITY,
    GRIP_DAMPING,
    GRIP_STIFFNESS,
    TABLE_INERTIA,
    TABLE_LENGTH,
    TABLE_MASS,
    WEIGHT_SHARE,
)


class Moving(NamedTuple):
    """The motion of the lifts, changed by each frame; all (n,)."""

    height: jax.Array
    """Height of the person's end [m]."""
    velocity: jax.Array
    """Its velocity [m/s]."""
    pitch: jax.Array
    """Pitch of the table [rad]."""
    pitch_rate: jax.Array
    """Rate of the pitch [rad/s]."""
    far_height: jax.Array
    """Height of the far end [m]."""
    far_velocity: jax.Array
    """Its velocity [m/s]."""
    far_force: jax.Array
    """Force of the far hands on the table [N]."""
    reference: jax.Array
    """The height that the person's arms pull towards, with the reflex [m]."""
    reflex: jax.Array
    """Shift of the reference by the reflex [m]."""
    arm: Arm
    """The NAO's arms."""
    pulled: jax.Array
    """Sum of the far hands' force over the frames since it was last set to zero [N]."""


class Plant(NamedTuple):
    """The state of n lifts; histories are (depth, n), newest first."""

    moving: Moving
    heights: jax.Array
    """History of the person's end [m]."""
    differences: jax.Array
    """History of the far end's height above the person's [m]."""
    forces: jax.Array
    """History of the force of the person's hands, beyond the share of the weight [N]."""

    @property
    def hand(self) -> jax.Array:
        """Height of the far hands by their encoders [m]."""
        return self.moving.arm.hand


def plant_at_rest(count: int, load: jax.Array | float = 1.0, depth: int = DEPTH) -> Plant:
    """Return lifts at rest.

    Parameters
    ----------
    count
        Number of lifts.
    load
        Mass of their tables relative to the benchmark's.
    depth
        Frames of the past heights that are kept.
    """
    zero, past = jnp.zeros(count), jnp.zeros((depth, count))
    arms = arms_at_rest(count, load)
    moving = Moving(zero, zero, zero, zero, zero, zero, arms.load, zero, zero, arms, zero)
    return Plant(moving, past, past, jnp.zeros((DEPTH, count)))


def advance_plant(
    plant: Plant,
    body: Body,
    references: jax.Array,
    commands: jax.Array,
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
        (frames, n) heights that the person's arms pull towards at the end of each frame, without
        the reflex [m].
    commands
        (frames, n) commanded height of the far hands at the end of each frame [m].
    variation
        Variation of the arms; None is the benchmark's arms.
    """
    count = len(references)
    implicit = 1 + FRAME * GRIP_DAMPING / (TABLE_INERTIA * body.load) / 2
    shifts = wanted_shift(
        body,
        delayed(plant.differences, body.seen, count),
        delayed(plant.forces, body.felt, count),
    )

    def frame(
        now: Moving, due: tuple[jax.Array, jax.Array, jax.Array]
    ) -> tuple[Moving, tuple[jax.Array, jax.Array, jax.Array]]:
        wanted, shift, command = due
        reflex = activated(now.reflex, shift)
        grip = (GRIP_STIFFNESS * now.pitch + GRIP_DAMPING * now.pitch_rate) / implicit
        arm = drive(now.arm, command, now.far_force, variation)
        after, force = after_physics_step(now, wanted + reflex, body, arm, grip)
        after = after._replace(reflex=reflex)
        return after, (after.height, after.far_height - after.height, force)

    moving, (heights, differences, forces) = each_frame(
        frame, plant.moving, (references, shifts, commands)
    )
    return Plant(
        moving=moving,
        heights=pushed(plant.heights, heights),
        differences=pushed(plant.differences, differences),
        forces=pushed(plant.forces, forces),
    )


def after_physics_step(
    now: Moving,
    reference: jax.Array,
    body: Body,
    arm: Arm,
    grip: jax.Array,
    *,
    pressed: jax.Array | float = 0.0,
    step: float = FRAME,
) -> tuple[Moving, jax.Array]:
    """Return the lifts a physics step later, and the hands' force beyond the weight [N].

    Parameters
    ----------
    now
        The lifts.
    body
        The people, with gains for steps of this duration.
    grip
        (n,) torque with which the grips resist the pitch [Nm].
    reference
        (n,) height that the person's arms pull towards at the end of the step, with the reflex [m].
    arm
        The NAO's arms after the step.
    pressed
        (n,) generalised force of loads on the table on the height of the person's hands [N].
    step
        Duration [s].
    """
    mass, table = body.mass, TABLE_MASS * body.load
    arms = body.stiffness * (now.reference - now.height)
    arms = arms + body.damping * ((reference - now.reference) / step - now.velocity)
    far_velocity = (arm.hand - now.far_height) / step

    square = ((now.far_height - now.height) / TABLE_LENGTH) ** 2
    tilted = table / 12 * (1 + square) + (2 * mass + table / 4) * square
    carried = (table / 4 - tilted) * (far_velocity - now.far_velocity) / step
    driving = arms + grip / TABLE_LENGTH * (1 + square / 2) - carried + pressed
    acceleration = driving / (mass + table / 4 + tilted)

    velocity = now.velocity + step * acceleration
    height = now.height + step * velocity
    sine = (arm.hand - height) / TABLE_LENGTH
    pitch_rate = (far_velocity - velocity) / TABLE_LENGTH * (1 + sine**2 / 2)
    centre = acceleration + TABLE_LENGTH / 2 / step * (pitch_rate - now.pitch_rate)
    force = arms - mass * acceleration
    far_force = table * (GRAVITY + centre) - force - WEIGHT_SHARE * body.load
    after = Moving(
        height=height,
        velocity=velocity,
        pitch=sine * (1 + sine**2 / 6),
        pitch_rate=pitch_rate,
        far_height=arm.hand,
        far_velocity=far_velocity,
        far_force=far_force,
        reference=reference,
        reflex=now.reflex,
        arm=arm,
        pulled=now.pulled + far_force,
    )
    return after, force
