"""A step of lifts: the person's voluntary correction, the sensors, and the frames of a step."""

from collections.abc import Callable
from typing import NamedTuple, TypeVar

import jax
import jax.numpy as jnp
from colift.agents.actions import action_limit
from colift.agents.agent import FRAME
from colift.agents.humans.hand import corrected
from colift.benchmark.episode.drops import pulled_off, slides_off
from colift.benchmark.episode.seat import REFERENCE_RANGE, limited_command
from colift.benchmark.twin.arm import ArmVariation
from colift.benchmark.twin.body import Body, delayed
from colift.benchmark.twin.functions import LIFTS
from colift.benchmark.twin.lifts import Lifts, chunk
from colift.benchmark.twin.pair import PairPlant
from colift.benchmark.twin.plant import Plant, advance_plant, plant_at_rest
from colift.robots.nao.kinematics import STROKE


class LiftState(NamedTuple):
    """The state of n lifts between two steps."""

    plant: Plant
    command: jax.Array
    """(n,) command of the far hands [m]."""
    correction: jax.Array
    """(n,) the person's voluntary correction [m]."""
    step: jax.Array
    """() number of the coming step."""


class Due(NamedTuple):
    """A step's share of :class:`.Lifts`."""

    reference: jax.Array
    """(f, n)"""
    seen_target: jax.Array
    """(n,)"""
    noise: jax.Array
    """(2, n)"""


class Frames(NamedTuple):
    """Heights in the frames of a step [m]."""

    human_end: jax.Array
    """(f, n)"""
    robot_end: jax.Array
    """(f, n)"""

    def squares(self) -> jax.Array:
        """Return the sum of squared height differences of each lift (n,) [m2]."""
        return ((self.human_end - self.robot_end) ** 2).sum(axis=0)


def at_rest(count: int) -> LiftState:
    """Return lifts at rest."""
    zero = jnp.zeros(count)
    return LiftState(plant_at_rest(count), zero, zero, jnp.zeros((), jnp.int32))


def due(lifts: Lifts, step: jax.Array) -> Due:
    """Return a step's share of the lifts; after the last step, that of the last."""
    return Due(lifts.reference[step], lifts.seen_target[step], lifts.noise[step])


def observe(playing: LiftState, noise: jax.Array, latency: jax.Array, period: float) -> jax.Array:
    """Return the robot's observations (5, n), laid out as :class:`.RobotObservation`.

    Parameters
    ----------
    playing
        The lifts.
    noise
        (2, n) error of the sample [m].
    latency
        (n,) age of the sample in frames.
    period
        Control period [s].
    """
    (human_end,) = delayed(playing.plant.heights, latency, 1)
    robot_end = human_end + delayed(playing.plant.differences, latency, 1)[0]
    time = jnp.full_like(human_end, period) * playing.step
    return jnp.stack(
        (human_end + noise[0], robot_end + noise[1], playing.plant.hand, playing.command, time)
    )


def references(
    correction: jax.Array, heights: jax.Array, body: Body, now: Due
) -> tuple[jax.Array, jax.Array]:
    """Return the voluntary correction after a step (n,), and the hands' references (f, n) [m].

    ``heights`` is the history of the person's end (DEPTH, n), newest first [m].
    """
    missing = now.seen_target - delayed(heights, body.seen, 1)[0]
    after = corrected(LIFTS, correction, missing, len(now.reference))
    return after, ramp(correction, after, len(now.reference)) + now.reference


def control_step(
    playing: LiftState,
    body: Body,
    now: Due,
    action: jax.Array,
    variation: ArmVariation | None = None,
) -> tuple[LiftState, Frames]:
    """Return the lifts after a step, and the heights in its frames.

    Parameters
    ----------
    playing
        The lifts.
    body
        The people.
    now
        The step's share of the lifts.
    action
        (n,) change of the command [m], clipped to the hands' speed and stroke.
    variation
        Variation of the arms; None is the benchmark's arms.
    """
    correction, hands = references(playing.correction, playing.plant.heights, body, now)
    playing, frames = hands_step(playing, body, hands, action, variation)
    return playing._replace(correction=correction), frames


def hands_step(
    playing: LiftState,
    body: Body,
    hands: jax.Array,
    action: jax.Array,
    variation: ArmVariation | None = None,
) -> tuple[LiftState, Frames]:
    """Return the lifts after a step in which the person's hand is moved from outside.

    Parameters
    ----------
    playing
        The lifts; the person's voluntary correction is left as it is.
    body
        The people.
    hands
        (f, n) heights that their hands pull towards in each frame [m]; they are clipped to their
        range.
    action, variation
        As for :func:`control_step`.

    Returns
    -------
    tuple
        The lifts, and the heights in the frames of the step.
    """
    size = hands.shape[0]
    command = limited_command(LIFTS, playing.command, action, action_limit(size * FRAME), STROKE)
    hands = jnp.clip(hands, *REFERENCE_RANGE)
    commands = ramp(playing.command, command, size)

    def move(state: Plant, first: int, last: int) -> Plant:
        return advance_plant(state, body, hands[first:last], commands[first:last], variation)

    moving = playing.plant.moving._replace(pulled=jnp.zeros_like(command))
    state, frames = in_chunks(playing.plant._replace(moving=moving), size, move)
    return LiftState(state, command, playing.correction, playing.step + 1), frames


Held = TypeVar("Held", Plant, PairPlant)


def in_chunks(
    state: Held, size: int, move: Callable[[Held, int, int], Held]
) -> tuple[Held, Frames]:
    """Return the state after a step of ``size`` frames, and the heights in these.

    ``move`` returns the state after the frames from a first to before a last one.
    """
    heights, differences = [], []
    many = chunk(size)
    for first in range(0, size, many):
        state = move(state, first, first + many)
        heights.append(state.heights[:many][::-1])
        differences.append(state.differences[:many][::-1])
    human_end = jnp.concatenate(heights)
    return state, Frames(human_end, human_end + jnp.concatenate(differences))


def ramp(start: jax.Array, stop: jax.Array, size: int) -> jax.Array:
    """Return values (f, n) that move at constant speed from ``start`` to ``stop``, both (n,)."""
    share = jnp.arange(1, size + 1, dtype=float)[:, jnp.newaxis] / size
    return start + (stop - start) * share


def dropped(playing: LiftState, size: int) -> jax.Array:
    """Return whether each table (n,) was dropped in the step just made, of ``size`` frames.

    The tests are those of :meth:`.Level.failure`, except that of the gap: the twin's hands never
    let go.
    """
    plant = playing.plant
    return jnp.logical_or(
        slides_off(LIFTS, plant.differences[0]), pulled_off(LIFTS, plant.moving.pulled, size)
    )
