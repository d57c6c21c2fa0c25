"""The plant with a ball on the table, which keeps the past places of the ball."""

from typing import Final, NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.agent import HISTORY
from colift.benchmark.twin.arm import ArmVariation
from colift.benchmark.twin.body import DEPTH, Body
from colift.benchmark.twin.haptic_plant import (
    HapticPlant,
    Meant,
    advance_haptic_plant,
    haptic_plant_at_rest,
)
from colift.benchmark.twin.rolling import WEIGHT, Rolling

PLACES: Final = DEPTH + HISTORY - 1
"""Number of past places of the ball that are kept: a person sees ten at a time."""


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
    moving = moving._replace(far_force=moving.far_force + WEIGHT / 2)
    touch = haptic.touch.at[:, 0].add(WEIGHT / 2)
    haptic = haptic._replace(plant=haptic.plant._replace(moving=moving), touch=touch)
    return BallPlant(haptic, Rolling(zero, zero, zero), jnp.zeros((PLACES, count)))


def advance_ball_plant(
    state: BallPlant,
    body: Body,
    meant: Meant,
    commands: jax.Array,
    variation: ArmVariation | None = None,
) -> BallPlant:
    """Return the lifts some frames later; parameters as for :func:`.advance_haptic_plant`."""
    haptic, ball, places = advance_haptic_plant(
        state.haptic, body, meant, commands, variation, state.ball
    )
    assert ball is not None
    assert places is not None
    return BallPlant(haptic, ball, jnp.concatenate((places[::-1], state.places))[:PLACES])
