"""A step of lifts with a ball: steering, sensors, frames; and whole lifts."""

import math
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from ...agents.agent import FRAME, HISTORY
from ...agents.ball.facts import PULL
from ...agents.ball.steerer import DAMPING_RATIO, FARTHEST, FASTEST, HAND_TIME, MEMORY, STEEPEST
from ..episode.metrics import FAILED_FRAME_MM
from ..episode.seat import REFERENCE_RANGE
from ..tasks.ball.lift import STEEPEST_MEANT
from ..world.table import TABLE_LENGTH
from .arm import ArmVariation
from .ball_lifts import BallLifts
from .ball_plant import BallPlant, advance_ball_plant, ball_plant_at_rest
from .body import DEPTH, delayed, pushed
from .haptic_plant import Meant
from .haptic_playing import commanded, moved_hand, sensed_by_hands
from .lifts import chunk
from .rollout import Policy


class BallState(NamedTuple):
    """The state of n lifts between two steps; histories are (DEPTH, n), newest first."""

    table: BallPlant
    command: jax.Array
    """(n,) command of the far hands [m]."""
    correction: jax.Array
    """(n,) the person's voluntary correction [m]."""
    error: jax.Array
    """(n,) error of the hand by motor noise [m]."""
    offset: jax.Array
    """(n,) how far steering has the own end from the plan [m]."""
    wanted: jax.Array
    """(n,) height difference that the person wanted in the last step [m]."""
    product: jax.Array
    """(n,) of the regression of the partner's part, see :class:`.Steering`."""
    square: jax.Array
    """(n,) of the same."""
    plans: jax.Array
    """History of the planned height [m]."""
    targets: jax.Array
    """History of the intended height, with the steering [m]."""
    lost: jax.Array
    """(n,) 1 if the ball has fallen, else 0."""
    step: jax.Array
    """() number of the coming step."""


def balls_at_rest(count: int) -> BallState:
    """Return lifts at rest."""
    zero, past = jnp.zeros(count), jnp.zeros((DEPTH, count))
    square = jnp.full(count, 1e-4)
    table, number = ball_plant_at_rest(count), jnp.zeros((), jnp.int32)
    return BallState(table, zero, zero, zero, zero, zero, zero, square, past, past, zero, number)


def ball_view(state: BallState, lifts: BallLifts, noise: jax.Array, coming: jax.Array) -> Any:
    """Return the robot's observations (10, n), laid out as :class:`.BallObservation`.

    Parameters
    ----------
    state, lifts
        The lifts.
    noise
        (5, n) error of the sensors.
    coming
        (HISTORY, n) where the ball should be [m] at the end of each of the next frames.
    """
    time = state.step * lifts.gain.shape[1] * FRAME
    touch = sensed_by_hands(state.table.haptic, state.command, time, noise[:4], lifts.latency)
    place = delayed(state.table.places[:DEPTH], lifts.latency, 1)[0] + noise[4]
    ball = jnp.stack((place, coming[0] * lifts.shown, lifts.shown))
    return jnp.concatenate((touch, ball))


class Steered(NamedTuple):
    """What steering adds in a step."""

    offsets: jax.Array
    """(f, n) distance of the own end from the plan in each frame [m]."""
    wanted: jax.Array
    product: jax.Array
    square: jax.Array


def steered(state: BallState, lifts: BallLifts, coming: jax.Array, size: int) -> Steered:
    """Return what the people at the near end do to steer; see :class:`.Steering`."""
    manner, seen = lifts.manner, lifts.body.seen
    plant = state.table.haptic.plant
    (own,) = delayed(plant.heights, seen, 1)
    (difference,) = delayed(plant.differences, seen, 1)
    kept, period = math.exp(-size * FRAME / MEMORY), size * FRAME
    partner = own + difference - delayed(state.plans, seen, 1)[0]
    product = kept * state.product + period * partner * state.wanted
    square = kept * state.square + period * state.wanted**2
    done = jnp.clip(product / (square + 1e-4), 0.0, 1.0)

    # The oldest of the ten places is nine frames older than the newest.
    places = state.table.places
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

    offset, offsets = state.offset, []
    for _ in range(size):
        change = (aim - offset) * FRAME / HAND_TIME
        offset = offset + jnp.clip(change, -FASTEST * FRAME, FASTEST * FRAME)
        offsets.append(offset)
    return Steered(jnp.stack(offsets), wanted, product, square)


class BallDue(NamedTuple):
    """A step's share of :class:`.BallLifts`, see there."""

    target: jax.Array
    coming: jax.Array
    gain: jax.Array
    tremor: jax.Array


def ball_step(
    state: BallState,
    lifts: BallLifts,
    due: BallDue,
    action: jax.Array,
    variation: ArmVariation | None = None,
) -> tuple[BallState, jax.Array]:
    """Return the lifts after a step, and the places of the ball in its frames (f, n) [m].

    Parameters
    ----------
    state, lifts
        The lifts.
    due
        The step's share of them.
    action
        (n,) change of the command [m], cut to the hands' speed and stroke.
    variation
        Arms that differ from the benchmark's; none: its own.
    """
    size, body, plant = len(due.gain), lifts.body, state.table.haptic.plant
    steering = steered(state, lifts, due.coming, size)
    targets = due.target + steering.offsets
    hand = moved_hand(state, targets, plant.heights, body, due)
    differences = due.target - hand.references
    part, limit = lifts.manner.wrist / lifts.manner.share, STEEPEST_MEANT * TABLE_LENGTH
    wrist = jnp.arcsin(jnp.clip(part * differences, -limit, limit) / TABLE_LENGTH)
    references = jnp.clip(hand.references, *REFERENCE_RANGE)
    commands = commanded(state.command, action, size)

    table, places = state.table, []
    many = chunk(size)
    for first in range(0, size, many):
        frames = slice(first, first + many)
        meant = Meant(references[frames], differences[frames], wrist[frames])
        table = advance_ball_plant(table, body, meant, commands[frames], variation)
        places.append(table.places[:many][::-1])
    place = jnp.concatenate(places)
    fell = (jnp.abs(place).max(axis=0) > TABLE_LENGTH / 2).astype(jnp.float32)
    after = BallState(
        table=table,
        command=commands[-1],
        correction=hand.correction,
        error=hand.error,
        offset=steering.offsets[-1],
        wanted=steering.wanted,
        product=steering.product,
        square=steering.square,
        plans=pushed(state.plans, due.target),
        targets=pushed(state.targets, targets),
        lost=jnp.maximum(state.lost, fell),
        step=state.step + 1,
    )
    return after, place


def ball_rmse_mm(
    policy: Policy, memory: Any, lifts: BallLifts, variation: ArmVariation | None = None
) -> jax.Array:
    """Return the RMSE of the ball (n,) [mm] of lifts with a policy; differentiable.

    A ball that rolls off the table stays where it fell, and each frame of the steps after that
    counts :data:`.FAILED_FRAME_MM`, as in the engine: the loss is finite. Its gradient comes from
    the frames until then alone, in which the ball is already farther off than that.

    Parameters
    ----------
    policy, memory
        The policy, and its memory at the beginning.
    lifts
        People, plans and noise.
    variation
        Arms that differ from the benchmark's; none: its own.
    """
    _, size, count = lifts.gain.shape
    cut = (FAILED_FRAME_MM / 1000) ** 2

    def step(
        held: tuple[BallState, Any], now: tuple[BallDue, jax.Array, jax.Array]
    ) -> tuple[tuple[BallState, Any], jax.Array]:
        (state, memory), (due, noise, should) = held, now
        memory, action = policy(memory, ball_view(state, lifts, noise, due.coming))
        valid, lost = (state.step < lifts.steps).astype(jnp.float32), state.lost
        state, places = ball_step(state, lifts, due, action, variation)
        squares = jnp.where(lost > 0, size * cut, ((places - should) ** 2).sum(axis=0))
        return (state, memory), squares * valid

    shares = BallDue(lifts.target, lifts.coming, lifts.gain, lifts.tremor)
    _, squares = jax.lax.scan(
        jax.checkpoint(step), (balls_at_rest(count), memory), (shares, lifts.noise, lifts.place)
    )
    return 1000 * jnp.sqrt(squares.sum(axis=0) / (lifts.steps * size) + 1e-12)
