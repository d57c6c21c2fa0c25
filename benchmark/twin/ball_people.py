"""People who steer a ball, many at a time: the distance of their end from the plan."""

import math
from typing import NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.agent import FRAME, HISTORY
from colift.agents.ball.facts import PULL
from colift.agents.humans.ball.steerer import (
    DAMPING_RATIO,
    FARTHEST,
    FASTEST,
    HAND_TIME,
    MEMORY,
    STEEPEST,
)
from colift.benchmark.twin.ball_lifts import BallLifts
from colift.benchmark.twin.ball_plant import BallPlant
from colift.benchmark.twin.body import DEPTH, delayed


class SteeringMind(NamedTuple):
    """The memory of n people who steer; all (n,)."""

    offset: jax.Array
    """Distance of the person's end from the plan, due to steering [m]."""
    wanted: jax.Array
    """Height difference that they wanted in the last step [m]."""
    product: jax.Array
    """Sum of products in the regression of the partner's part, see :class:`.Steering`."""
    square: jax.Array
    """Sum of squares in that regression."""


def steering_minds(count: int) -> SteeringMind:
    """Return people at the beginning of a lift."""
    zero = jnp.zeros(count)
    return SteeringMind(zero, zero, zero, jnp.full(count, 1e-4))


def steered(
    mind: SteeringMind,
    lifts: BallLifts,
    table: BallPlant,
    plans: jax.Array,
    coming: jax.Array,
    size: int,
) -> tuple[SteeringMind, jax.Array]:
    """Return minds after a step, and the distances of their ends from the plan in it (f, n) [m].

    This is the counterpart of :class:`.Steering`.

    Parameters
    ----------
    mind, lifts, table
        The people, their lifts, and the table with its ball.
    plans
        (DEPTH, n) history of the planned height [m], newest first.
    coming
        (HISTORY, n) intended place of the ball at the end of each of the next frames [m].
    size
        Frames of the step, f.
    """
    manner, seen = lifts.manner, lifts.body.seen
    plant = table.haptic.plant
    (own,) = delayed(plant.heights, seen, 1)
    (difference,) = delayed(plant.differences, seen, 1)
    kept, period = math.exp(-size * FRAME / MEMORY), size * FRAME
    partner = own + difference - delayed(plans, seen, 1)[0]
    product = kept * mind.product + period * partner * mind.wanted
    square = kept * mind.square + period * mind.wanted**2
    done = jnp.clip(product / (square + 1e-4), 0.0, 1.0)

    # The oldest of the ten places is nine frames older than the newest.
    places = table.places
    newest = delayed(places[:DEPTH], seen, 1)[0]
    oldest = delayed(places[HISTORY - 1 :], seen, 1)[0]
    speed = (newest - oldest) / (FRAME * (HISTORY - 1))
    lead = manner.lead
    place = newest + lead * speed - PULL * difference * lead**2 / 2
    speed = speed - PULL * difference * lead
    half = (HISTORY - 1) // 2
    first, middle, last = coming[0], coming[half], coming[2 * half]
    span = half * FRAME
    slip = speed - (last - first) / (2 * span)
    push = (last - 2 * middle + first) / span**2
    rate = manner.haste
    wanted = (rate**2 * (place - middle) + 2 * DAMPING_RATIO * rate * slip - push) / PULL
    wanted = jnp.clip(wanted, -STEEPEST, STEEPEST)
    aim = -manner.share * (1 - manner.trust * done) * wanted
    aim = jnp.clip(aim, -FARTHEST, FARTHEST)

    offset, offsets = mind.offset, []
    for _ in range(size):
        change = (aim - offset) * FRAME / HAND_TIME
        offset = offset + jnp.clip(change, -FASTEST * FRAME, FASTEST * FRAME)
        offsets.append(offset)
    return SteeringMind(offset, wanted, product, square), jnp.stack(offsets)
