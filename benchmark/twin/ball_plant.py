"""The plant with a ball on the table, in the physics steps of its task."""

from typing import Final, NamedTuple

import jax
import jax.numpy as jnp

from ...agents.agent import FRAME, HISTORY
from ..tasks.ball.task import BALL, FINER
from ..world.ball import ROLLING
from ..world.haptic_world import FAR_GRIP_DAMPING, FAR_GRIP_STIFFNESS
from ..world.table import (
    GRAVITY,
    GRIP_DAMPING,
    GRIP_STIFFNESS,
    TABLE_INERTIA,
    TABLE_LENGTH,
    WEIGHT_SHARE,
)
from .arm import ArmVariation, followed, prepared
from .body import DEPTH, Body, activated
from .haptic_plant import (
    Felt,
    HapticPlant,
    Meant,
    haptic_plant_at_rest,
    remembered,
    shifts_of_reflex,
)
from .plant import Moving, after_physics_step

STEPS: Final = FINER.steps_per_frame
"""Physics steps of a frame."""

PLACES: Final = DEPTH + HISTORY - 1
"""Frames of the past of the ball: a person sees ten at a time."""

_STEP: Final = FINER.step
_IMPLICIT: Final = 1 + _STEP * (GRIP_DAMPING + FAR_GRIP_DAMPING) / TABLE_INERTIA / 2
_WEIGHT: Final = BALL.mass * GRAVITY
_HALF: Final = TABLE_LENGTH / 2


class Rolling(NamedTuple):
    """The balls of n lifts; all (n,)."""

    place: jax.Array
    """s, from the middle towards the far end [m]."""
    speed: jax.Array
    """w, of the centre along the table [m/s]."""
    slide: jax.Array
    """Velocity of the person's end away from the far end [m/s]."""


class BallPlant(NamedTuple):
    """The state of n lifts with a ball."""

    haptic: HapticPlant
    ball: Rolling
    places: jax.Array
    """(PLACES, n) history of the ball's place [m], newest first."""


def ball_plant_at_rest(count: int) -> BallPlant:
    """Return lifts at rest with the ball in the middle."""
    haptic, zero = haptic_plant_at_rest(count), jnp.zeros(count)
    moving = haptic.plant.moving
    moving = moving._replace(far_force=moving.far_force + _WEIGHT / 2)
    touch = haptic.touch.at[:, 0].add(_WEIGHT / 2)
    haptic = haptic._replace(plant=haptic.plant._replace(moving=moving), touch=touch)
    return BallPlant(haptic, Rolling(zero, zero, zero), jnp.zeros((PLACES, count)))


def rolled(ball: Rolling, before: Moving, after: Moving) -> Rolling:
    """Return the balls a physics step later; see :meth:`.Ball.rolled`.

    The person's end slides by L (cos p - 1) while the table turns about the far end. A ball beyond
    the table's edge has fallen, and stays.
    """
    turn, pitch = after.pitch - before.pitch, (after.pitch + before.pitch) / 2
    slide = -TABLE_LENGTH * jnp.sin(pitch) * turn / _STEP
    rate, rise = turn / _STEP, (after.velocity - before.velocity) / _STEP
    shift = BALL.radius * turn
    middle = ball.place + (_STEP * ball.speed + shift) / 2
    pull = (_HALF + middle) * rate**2 - (GRAVITY + rise) * jnp.sin(pitch)
    pull = ROLLING * (pull + (slide - ball.slide) / _STEP * jnp.cos(pitch))
    pull = pull - BALL.friction * BALL.radius * rate
    drag = _STEP * BALL.friction / 2
    speed = (ball.speed * (1 - drag) + _STEP * pull) / (1 + drag)
    place = middle + (_STEP * speed + shift) / 2
    fallen = jnp.abs(ball.place) > _HALF
    return Rolling(
        place=jnp.where(fallen, ball.place, place),
        speed=jnp.where(fallen, 0.0, speed),
        slide=slide,
    )


Held = tuple[Moving, jax.Array, Rolling]


def advance_ball_plant(
    state: BallPlant,
    body: Body,
    meant: Meant,
    commands: jax.Array,
    variation: ArmVariation | None = None,
) -> BallPlant:
    """Return the lifts some frames later, at most :data:`.CHUNK`; see :class:`.HapticWorld`.

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
        Arms that differ from the benchmark's; none: its own.
    """
    haptic = state.haptic
    shifts = shifts_of_reflex(haptic, body, len(commands))

    def frame(
        held: Held, due: tuple[Meant, jax.Array, jax.Array]
    ) -> tuple[Held, tuple[Felt, jax.Array]]:
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
            normal = _WEIGHT * jnp.cos(now.pitch)
            level = TABLE_LENGTH * jnp.cos(now.pitch)
            pressed = normal * ((_HALF + ball.place) / level - jnp.cos(now.pitch)) + _WEIGHT / 2
            after, hands = after_physics_step(
                now,
                first + (last - first) * (begin + 1 / STEPS),
                body,
                followed(now.arm, target, begin, _STEP, variation),
                own / _IMPLICIT + far,
                pressed=pressed,
                step=_STEP,
            )
            return (after, wrist, rolled(ball, now, after)), (hands, after.far_force, -far)

        (now, _, ball), found = jax.lax.scan(
            physics_step, (now, wrist, ball), jnp.arange(STEPS) / STEPS
        )
        force, far_force, torque = (each.mean(axis=0) for each in found)
        far_force = far_force + _WEIGHT * jnp.cos(now.pitch) ** 2 - _WEIGHT / 2
        now = now._replace(
            far_force=far_force, reflex=reflex, arm=now.arm._replace(target=target, load=load)
        )
        difference = now.far_height - now.height
        touch = jnp.stack((far_force - WEIGHT_SHARE, torque))
        felt = Felt(now.height, difference, force, difference - wanted.difference, touch)
        return (now, wanted.wrist, ball), (felt, ball.place)

    (moving, wrist, ball), (felt, places) = jax.lax.scan(
        frame, (haptic.plant.moving, haptic.wrist, state.ball), (meant, shifts, commands)
    )
    return BallPlant(
        haptic=remembered(haptic, moving, wrist, felt),
        ball=ball,
        places=jnp.concatenate((places[::-1], state.places))[:PLACES],
    )
