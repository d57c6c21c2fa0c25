"""The plant of tasks with touch: wrists with an intended pitch, a far grip, and sensors."""

from typing import Final, NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.agent import FRAME
from colift.benchmark.episode.sensing import SENSED_FRAMES
from colift.benchmark.tasks.touch import FINER
from colift.benchmark.twin.arm import ArmVariation, followed, prepared
from colift.benchmark.twin.body import DEPTH, Body, activated, delayed, pushed, wanted_shift
from colift.benchmark.twin.inner import each_frame
from colift.benchmark.twin.plant import Moving, Plant, after_physics_step, plant_at_rest
from colift.benchmark.twin.rolling import Rolling, pressed_by, rolled, shared_load
from colift.benchmark.world.table import (
    FAR_GRIP_DAMPING,
    FAR_GRIP_STIFFNESS,
    GRIP_DAMPING,
    GRIP_STIFFNESS,
    TABLE_INERTIA,
    WEIGHT_SHARE,
)

_STEPS: Final = FINER.steps_per_frame
_STEP: Final = FINER.step
_IMPLICIT: Final = 1 + _STEP * (GRIP_DAMPING + FAR_GRIP_DAMPING) / TABLE_INERTIA / 2


class HapticPlant(NamedTuple):
    """The state of n lifts; histories are (DEPTH, n), newest first."""

    plant: Plant
    uneven: jax.Array
    """History of the far end's height above the person's, less the intended difference [m]."""
    wrist: jax.Array
    """(n,) pitch that the wrists turn towards at the end of the last frame [rad]."""
    touch: jax.Array
    """(SENSED_FRAMES, 2, n) force beyond half of the weight [N] and torque [Nm] of the far hands in
    the last frames."""


def haptic_plant_at_rest(count: int) -> HapticPlant:
    """Return lifts at rest."""
    return HapticPlant(
        plant=plant_at_rest(count),
        uneven=jnp.zeros((DEPTH, count)),
        wrist=jnp.zeros(count),
        touch=jnp.zeros((SENSED_FRAMES, 2, count)),
    )


class Meant(NamedTuple):
    """A person's intention in some frames, each (frames, n)."""

    reference: jax.Array
    """Height that the arms pull towards at the end of each frame, without the reflex [m]."""
    difference: jax.Array
    """The intended height of the far end above the near one [m]."""
    wrist: jax.Array
    """The pitch that the wrists turn towards [rad]."""


class Felt(NamedTuple):
    """Additions of some frames to the histories of :class:`HapticPlant`, each (frames, ..., n)."""

    heights: jax.Array
    differences: jax.Array
    forces: jax.Array
    uneven: jax.Array
    touch: jax.Array


def remembered(state: HapticPlant, moving: Moving, wrist: jax.Array, felt: Felt) -> HapticPlant:
    """Return the lifts after some frames, from their motion and new entries of the histories."""
    plant = state.plant
    return HapticPlant(
        plant=Plant(
            moving=moving,
            heights=pushed(plant.heights, felt.heights),
            differences=pushed(plant.differences, felt.differences),
            forces=pushed(plant.forces, felt.forces),
        ),
        uneven=pushed(state.uneven, felt.uneven),
        wrist=wrist,
        touch=jnp.concatenate((state.touch, felt.touch))[-SENSED_FRAMES:],
    )


def shifts_of_reflex(state: HapticPlant, body: Body, count: int) -> jax.Array:
    """Return the shifts of references that the people's reflexes want in the next frames [m]."""
    return wanted_shift(
        body,
        delayed(state.uneven, body.seen, count),
        delayed(state.plant.forces, body.felt, count),
    )


Held = tuple[Moving, jax.Array, Rolling | None]
"""Motion of the lifts, pitch that the wrists turn towards, and balls, if there are any."""


def advance_haptic_plant(
    state: HapticPlant,
    body: Body,
    meant: Meant,
    commands: jax.Array,
    variation: ArmVariation | None = None,
    ball: Rolling | None = None,
) -> tuple[HapticPlant, Rolling | None, jax.Array | None]:
    """Return the lifts some frames later, at most :data:`.CHUNK`; see :class:`.BulletWorld`.

    Parameters
    ----------
    state
        The lifts.
    body
        The people, for the steps of :data:`.FINER`.
    meant
        Their intention.
    commands
        (frames, n) commanded height of the far hands at the end of each frame [m].
    variation
        Variation of the arms; None is the benchmark's arms.
    ball
        The balls on the tables, if there are any.

    Returns
    -------
    The lifts, the balls, and their places (frames, n) [m].
    """
    shifts = shifts_of_reflex(state, body, len(commands))

    def frame(
        held: Held, due: tuple[Meant, jax.Array, jax.Array]
    ) -> tuple[Held, tuple[Felt, jax.Array | None]]:
        (now, wrist, ball), (wanted, shift, command) = held, due
        reflex = activated(now.reflex, shift)
        first, last = now.reference, wanted.reference + reflex
        turn = (wanted.wrist - wrist) / FRAME
        load, target = prepared(now.arm, command, now.far_force, variation)

        def physics_step(held: Held, begin: jax.Array) -> tuple[Held, tuple[jax.Array, ...]]:
            now, _, ball = held
            meant_now = wrist + (wanted.wrist - wrist) * begin
            own = GRIP_STIFFNESS * (now.pitch - meant_now) + GRIP_DAMPING * (now.pitch_rate - turn)
            far = (FAR_GRIP_STIFFNESS * now.pitch + FAR_GRIP_DAMPING * now.pitch_rate) / _IMPLICIT
            after, hands = after_physics_step(
                now,
                first + (last - first) * (begin + 1 / _STEPS),
                body,
                followed(now.arm, target, begin, _STEP, variation),
                own / _IMPLICIT + far,
                pressed=0.0 if ball is None else pressed_by(ball, now.pitch),
                step=_STEP,
            )
            ball = None if ball is None else rolled(ball, now, after)
            return (after, wrist, ball), (hands, after.far_force, -far)

        (now, _, ball), found = each_frame(
            physics_step, (now, wrist, ball), jnp.arange(_STEPS) / _STEPS
        )
        force, far_force, torque = (each.mean(axis=0) for each in found)
        if ball is not None:
            far_force = far_force + shared_load(now.pitch)
        arm = now.arm._replace(target=target, load=load)
        now = now._replace(far_force=far_force, reflex=reflex, arm=arm)
        difference = now.far_height - now.height
        touch = jnp.stack((far_force - WEIGHT_SHARE, torque))
        felt = Felt(now.height, difference, force, difference - wanted.difference, touch)
        return (now, wanted.wrist, ball), (felt, None if ball is None else ball.place)

    (moving, wrist, ball), (felt, places) = each_frame(
        frame, (state.plant.moving, state.wrist, ball), (meant, shifts, commands)
    )
    return remembered(state, moving, wrist, felt), ball, places
