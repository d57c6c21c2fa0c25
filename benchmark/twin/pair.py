"""Two people on one table: the person of every lift, and a second one in the robot's place.

An open chain: slide x, hands z, pitch q. With the point masses M of the hands (2 M on the slide),
the table m of length L and the second person's mass n at its end,

    S = m L/2 + n L,  I = m L^2/3 + n L^2,  X = 2 M + m + n,
    (M + m + n) z'' + S cos(q) q''                     = F + G + S sin(q) q'^2
    S cos(q) z'' + (I - (S sin(q))^2 / X) q''          = L cos(q) G - k q - d q'
                                                         + S^2 sin(q) cos(q) q'^2 / X

with the forces F and G of the two people beyond the weight that they bear at rest; x is eliminated.
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
from .body import DEPTH, Body, delayed, pushed, reflexes

_HALF_MOMENT: Final = TABLE_MASS * TABLE_LENGTH / 2


class Pair(NamedTuple):
    """The state of n lifts; histories are (DEPTH, n), newest first, all else (n,)."""

    velocity: jax.Array
    """Of the first person's end [m/s]."""
    pitch: jax.Array
    """Of the table [rad]."""
    pitch_rate: jax.Array
    """[rad/s]"""
    reference: jax.Array
    """What the first person's arms pull towards, with the reflex [m]."""
    reflex: jax.Array
    """Shift of that reference by the reflex [m]."""
    far_reference: jax.Array
    """The same of the second person [m]."""
    far_reflex: jax.Array
    """Shift of that reference [m]."""
    heights: jax.Array
    """History of the first person's end [m]."""
    differences: jax.Array
    """History of the far end's height above the first person's [m]."""
    forces: jax.Array
    """History of the first person's force, beyond the share of the weight [N]."""
    far_forces: jax.Array
    """History of the second person's force, beyond the share of the weight [N]."""

    @property
    def hand(self) -> jax.Array:
        """Height of the second person's hands: they grip the end [m]."""
        return self.heights[0] + self.differences[0]

    @property
    def far_force(self) -> jax.Array:
        """Force of the second person's hands on the table [N]."""
        return self.far_forces[0] + WEIGHT_SHARE


def begin(count: int) -> Pair:
    """Return lifts at rest."""
    zero, past = jnp.zeros(count), jnp.zeros((DEPTH, count))
    return Pair(zero, zero, zero, zero, zero, zero, zero, past, past, past, past)


def advance(
    pair: Pair,
    body: Body,
    far_body: Body,
    references: Sequence[jax.Array],
    far_references: Sequence[jax.Array],
) -> Pair:
    """Return the lifts some frames later, at most :data:`.CHUNK`.

    Parameters
    ----------
    pair
        The lifts.
    body, far_body
        The first and the second person of each lift.
    references, far_references
        For each frame, what their arms pull towards at its end, without the reflex [m].
    """
    count = len(references)
    shifts = reflexes(
        body,
        pair.reflex,
        delayed(pair.differences, body.seen, count),
        delayed(pair.forces, body.felt, count),
    )
    far_shifts = reflexes(
        far_body,
        pair.far_reflex,
        delayed(-pair.differences, far_body.seen, count),
        delayed(pair.far_forces, far_body.felt, count),
    )
    height, velocity = pair.heights[0], pair.velocity
    pitch, rate = pair.pitch, pair.pitch_rate
    previous, far_previous = pair.reference, pair.far_reference
    mass, far_mass = body.mass, far_body.mass
    moment = _HALF_MOMENT + far_mass * TABLE_LENGTH
    inertia = TABLE_INERTIA + far_mass * TABLE_LENGTH**2
    sliding = 2 * mass + TABLE_MASS + far_mass
    implicit = 1 + FRAME * GRIP_DAMPING / inertia / 2
    heights, differences, forces, far_forces = [], [], [], []
    for wanted, far_wanted, shift, far_shift in zip(
        references, far_references, shifts, far_shifts, strict=True
    ):
        reference, far_reference = wanted + shift, far_wanted + far_shift
        sine, cosine = jnp.sin(pitch), jnp.cos(pitch)
        far_height = height + TABLE_LENGTH * sine
        far_velocity = velocity + TABLE_LENGTH * cosine * rate
        arms = body.stiffness * (previous - height)
        arms = arms + body.damping * ((reference - previous) / FRAME - velocity)
        far_arms = far_body.stiffness * (far_previous - far_height)
        far_arms = far_arms + far_body.damping * (
            (far_reference - far_previous) / FRAME - far_velocity
        )
        torque = TABLE_LENGTH * cosine * far_arms
        torque = torque - (GRIP_STIFFNESS * pitch + GRIP_DAMPING * rate) / implicit

        # Two equations for the accelerations of hands and pitch.
        whole, coupling = mass + TABLE_MASS + far_mass, moment * cosine
        turning = inertia - (moment * sine) ** 2 / sliding
        lift = arms + far_arms + moment * sine * rate**2
        turn = torque + moment**2 * sine * cosine * rate**2 / sliding
        determinant = whole * turning - coupling**2
        acceleration = (lift * turning - coupling * turn) / determinant
        angular = (whole * turn - coupling * lift) / determinant

        velocity, rate = velocity + FRAME * acceleration, rate + FRAME * angular
        height, pitch = height + FRAME * velocity, pitch + FRAME * rate
        force = arms - mass * acceleration
        centre = acceleration + TABLE_LENGTH / 2 * angular
        previous, far_previous = reference, far_reference
        heights.append(height)
        differences.append(TABLE_LENGTH * jnp.sin(pitch))
        forces.append(force)
        far_forces.append(TABLE_MASS * (GRAVITY + centre) - force - 2 * WEIGHT_SHARE)
    return Pair(
        velocity=velocity,
        pitch=pitch,
        pitch_rate=rate,
        reference=previous,
        reflex=shifts[-1],
        far_reference=far_previous,
        far_reflex=far_shifts[-1],
        heights=pushed(pair.heights, heights),
        differences=pushed(pair.differences, differences),
        forces=pushed(pair.forces, forces),
        far_forces=pushed(pair.far_forces, far_forces),
    )
