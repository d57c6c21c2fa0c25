"""Two people on one table: the person of every lift, and a second one in the robot's place.

An open chain: slide x, hands z, pitch q. With the point masses M of the hands (2 M on the slide),
the table m of length L and the second person's mass n at its end,

    S = m L/2 + n L,  I = m L^2/3 + n L^2,  X = 2 M + m + n,
    (M + m + n) z'' + S cos(q) q''                     = F + G + S sin(q) q'^2
    S cos(q) z'' + (I - (S sin(q))^2 / X) q''          = L cos(q) G - k q - d q'
                                                         + S^2 sin(q) cos(q) q'^2 / X

with the forces F and G of the two people beyond the weight that they carry at rest; x is
eliminated.
"""

from typing import Final, NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.agent import FRAME
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

_HALF_MOMENT: Final = TABLE_MASS * TABLE_LENGTH / 2


class MovingPair(NamedTuple):
    """The motion of the pairs, changed by each frame; all (n,)."""

    height: jax.Array
    """Height of the first person's end [m]."""
    velocity: jax.Array
    """Velocity of that end [m/s]."""
    pitch: jax.Array
    """Pitch of the table [rad]."""
    pitch_rate: jax.Array
    """Rate of the pitch [rad/s]."""
    reference: jax.Array
    """Height that the first person's arms pull towards, with the reflex [m]."""
    far_reference: jax.Array
    """Height that the second person's arms pull towards, with the reflex [m]."""
    reflex: jax.Array
    """Shift of the first reference by the reflex [m]."""
    far_reflex: jax.Array
    """Shift of the second reference by the reflex [m]."""


class PairPlant(NamedTuple):
    """The state of n lifts; histories are (DEPTH, n), newest first."""

    moving: MovingPair
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
        """Height of the second person's hands [m]."""
        return self.heights[0] + self.differences[0]


def pair_at_rest(count: int) -> PairPlant:
    """Return lifts at rest."""
    zero, past = jnp.zeros(count), jnp.zeros((DEPTH, count))
    return PairPlant(MovingPair(*[zero] * len(MovingPair._fields)), past, past, past, past)


def advance_pair(
    pair: PairPlant,
    body: Body,
    far_body: Body,
    references: jax.Array,
    far_references: jax.Array,
) -> PairPlant:
    """Return the lifts some frames later, at most :data:`.CHUNK`.

    Parameters
    ----------
    pair
        The lifts.
    body, far_body
        The first and the second person of each lift.
    references, far_references
        (frames, n) heights that their arms pull towards at the end of each frame, without the
        reflex [m].
    """
    count = len(references)
    shifts = wanted_shift(
        body,
        delayed(pair.differences, body.seen, count),
        delayed(pair.forces, body.felt, count),
    )
    far_shifts = wanted_shift(
        far_body,
        delayed(-pair.differences, far_body.seen, count),
        delayed(pair.far_forces, far_body.felt, count),
    )

    def frame(
        now: MovingPair, due: tuple[jax.Array, ...]
    ) -> tuple[MovingPair, tuple[jax.Array, ...]]:
        wanted, far_wanted, shift, far_shift = due
        reflex, far_reflex = activated(now.reflex, shift), activated(now.far_reflex, far_shift)
        after, force, far_force = _frame(
            now, body, far_body, wanted + reflex, far_wanted + far_reflex
        )
        after = after._replace(reflex=reflex, far_reflex=far_reflex)
        return after, (after.height, TABLE_LENGTH * jnp.sin(after.pitch), force, far_force)

    moving, (heights, differences, forces, far_forces) = each_frame(
        frame, pair.moving, (references, far_references, shifts, far_shifts)
    )
    return PairPlant(
        moving=moving,
        heights=pushed(pair.heights, heights),
        differences=pushed(pair.differences, differences),
        forces=pushed(pair.forces, forces),
        far_forces=pushed(pair.far_forces, far_forces),
    )


def _frame(
    now: MovingPair, body: Body, far_body: Body, reference: jax.Array, far_reference: jax.Array
) -> tuple[MovingPair, jax.Array, jax.Array]:
    """Return the lifts a frame later, and both people's forces beyond the weight [N]."""
    moment = _HALF_MOMENT + far_body.mass * TABLE_LENGTH
    inertia = TABLE_INERTIA + far_body.mass * TABLE_LENGTH**2
    sliding = 2 * body.mass + TABLE_MASS + far_body.mass
    sine, cosine = jnp.sin(now.pitch), jnp.cos(now.pitch)
    rate = now.pitch_rate
    far_height = now.height + TABLE_LENGTH * sine
    far_velocity = now.velocity + TABLE_LENGTH * cosine * rate

    arms = body.stiffness * (now.reference - now.height)
    arms = arms + body.damping * ((reference - now.reference) / FRAME - now.velocity)
    pull = (far_reference - now.far_reference) / FRAME
    far_arms = far_body.stiffness * (now.far_reference - far_height)
    far_arms = far_arms + far_body.damping * (pull - far_velocity)
    implicit = 1 + FRAME * GRIP_DAMPING / inertia / 2
    grip = (GRIP_STIFFNESS * now.pitch + GRIP_DAMPING * rate) / implicit

    # Two equations for the accelerations of hands and pitch.
    whole, coupling = body.mass + TABLE_MASS + far_body.mass, moment * cosine
    turning = inertia - (moment * sine) ** 2 / sliding
    lift = arms + far_arms + moment * sine * rate**2
    turn = TABLE_LENGTH * cosine * far_arms - grip + moment**2 * sine * cosine * rate**2 / sliding
    determinant = whole * turning - coupling**2
    acceleration = (lift * turning - coupling * turn) / determinant
    angular = (whole * turn - coupling * lift) / determinant

    velocity, rate = now.velocity + FRAME * acceleration, rate + FRAME * angular
    force = arms - body.mass * acceleration
    centre = acceleration + TABLE_LENGTH / 2 * angular
    after = now._replace(
        height=now.height + FRAME * velocity,
        velocity=velocity,
        pitch=now.pitch + FRAME * rate,
        pitch_rate=rate,
        reference=reference,
        far_reference=far_reference,
    )
    return after, force, TABLE_MASS * (GRAVITY + centre) - force - 2 * WEIGHT_SHARE
