"""The balls that roll on the tables of lifts, a physics step at a time."""

from typing import Final, NamedTuple

import jax
import jax.numpy as jnp
from colift.benchmark.tasks.ball.task import BALL
from colift.benchmark.tasks.touch import FINER
from colift.benchmark.twin.plant import Moving
from colift.benchmark.world.ball import ROLLING
from colift.benchmark.world.table import GRAVITY, TABLE_LENGTH

WEIGHT: Final = BALL.mass * GRAVITY
"""Weight of a ball [N]; the two holders carry half of it each."""

_STEP: Final = FINER.step
_HALF: Final = TABLE_LENGTH / 2


class Rolling(NamedTuple):
    """The balls of n lifts; all (n,)."""

    place: jax.Array
    """s, place of the ball from the middle towards the far end [m]."""
    speed: jax.Array
    """w, speed of the centre along the table [m/s]."""
    slide: jax.Array
    """Velocity of the person's end away from the far end [m/s]."""


def pressed_by(ball: Rolling, pitch: jax.Array) -> jax.Array:
    """Return the force (n,) of balls on the height of the person's hands, beyond half [N]."""
    level = TABLE_LENGTH * jnp.cos(pitch)
    lever = (_HALF + ball.place) / level - jnp.cos(pitch)
    return WEIGHT * jnp.cos(pitch) * lever + WEIGHT / 2


def shared_load(pitch: jax.Array) -> jax.Array:
    """Return the vertical force (n,) of balls on tables beyond the person's half [N]."""
    return WEIGHT * jnp.cos(pitch) ** 2 - WEIGHT / 2


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
