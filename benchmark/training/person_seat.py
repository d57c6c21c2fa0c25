"""The person's seat in the twin for a learner: a private goal, its senses, its hand, its cost.

It has no behaviour of the benchmark: no plan, no stroke, no motor noise, and no correction. A goal
is a height without a movement; the way of the hand is learned. The arms and reflexes of the drawn
people remain, as they are part of the plant.
"""

from collections.abc import Iterable
from typing import Final, NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.agent import FRAME
from colift.agents.humans import GOAL_RANGE
from colift.agents.senses import MOCAP_NOISE
from colift.benchmark.episode.scenario import CONTROL_PERIOD
from colift.benchmark.episode.seat import REFERENCE_RANGE, body_parameters
from colift.benchmark.suites.catalogue import make_subject
from colift.benchmark.twin.body import Body, bodies, delayed
from colift.benchmark.twin.playing import Frames, LiftState, ramp

STEPS: Final = 80
"""Length of a lift: 8 s."""

CHANGES: Final = 0.05
"""Probability of a new goal in each step: one every 2 s on average."""

FRAMES: Final = round(CONTROL_PERIOD / FRAME)
"""Frames of a step."""

PACE: Final = 0.02
"""Largest movement of an uncorrected hand in a step [m]: 0.2 m/s."""

CORRECTION: Final = 0.03
"""Largest correction of that movement in a step [m]: a hand makes up to 0.5 m/s."""

SCALES: Final = (0.1, 0.1, 0.02, 0.02, 0.02, 0.02, 0.02, 5.0, 5.0)
"""Scale of each input [m]; of the last two [N]."""

CENTIMETRE: Final = 0.01
"""One centimetre [m]."""


class Goals(NamedTuple):
    """n lifts without a plan."""

    goal: jax.Array
    """(s, n) height that the person wants for the person's own end [m]."""
    noise: jax.Array
    """(s, 2, n) error of the motion capture at either end, for the robot [m]."""
    body: Body
    """The people's arms."""


def people(seeds: Iterable[int]) -> Body:
    """Return the arms of the people with some seeds."""
    return bodies([body_parameters(make_subject(f"draw-{seed}")) for seed in seeds])


def draw_goals(body: Body, key: jax.Array) -> Goals:
    """Return a lift for each of n people: the goal is the rest height, then changes at times."""
    count = body.mass.shape[0]
    when, where, errors = jax.random.split(key, 3)
    heights = jax.random.uniform(where, (STEPS, count), minval=0.0, maxval=GOAL_RANGE[1])
    new = jax.random.bernoulli(when, CHANGES, (STEPS, count))
    last = jax.lax.cummax(jnp.where(new, jnp.arange(STEPS)[:, jnp.newaxis], -1))
    goal = jnp.where(last < 0, 0.0, jnp.take_along_axis(heights, last, axis=0))
    noise = MOCAP_NOISE * jax.random.normal(errors, (STEPS, 2, count))
    return Goals(goal, noise, body)


class Past(NamedTuple):
    """A person's memory of the last step; all (n,)."""

    hand: jax.Array
    """The hand's reference at the end of the step [m]."""
    seen: jax.Array
    """Seen height of the other end above the person's [m]."""
    felt: jax.Array
    """Felt force of the hands beyond the weight [N]."""


def nothing_sensed(count: int) -> Past:
    """Return the memory of ``count`` people before their lifts."""
    return Past(*[jnp.zeros(count)] * len(Past._fields))


def sense(playing: LiftState, body: Body, past: Past, goal: jax.Array) -> tuple[Past, jax.Array]:
    """Return the memory of the present senses, and the scaled inputs (n, 9).

    All of it is in the human's observation of the engine, :class:`.HumanObservation`.

    ====== ==================================================================
    0      height of the person's end
    1      goal above it
    2      hand's reference above it
    3, 4   change of the person's end in the last step, and in the one before
    5, 6   other end above it, a visual delay ago, and its change in a step
    7, 8   force of the hands beyond the weight, a haptic delay ago, and its change
    ====== ==================================================================

    Parameters
    ----------
    playing, body
        The lifts and the people.
    past
        Their memory.
    goal
        (n,) their goals [m].
    """
    now, before, earlier = (playing.plant.heights[age * FRAMES] for age in range(3))
    seen = delayed(playing.plant.differences, body.seen, 1)[0]
    felt = delayed(playing.plant.forces, body.felt, 1)[0]
    own = (now, goal - now, past.hand - now, now - before, before - earlier)
    inputs = jnp.stack((*own, seen, seen - past.seen, felt, felt - past.felt), axis=1)
    return Past(past.hand, seen, felt), inputs / jnp.asarray(SCALES)


def moved(past: Past, goal: jax.Array, action: jax.Array) -> tuple[Past, jax.Array]:
    """Return the memory after a step, and the hand's references in it (f, n) [m].

    The hand goes to the goal at :data:`PACE`, corrected by an action (n,).
    """
    change = jnp.clip(goal - past.hand, -PACE, PACE) + CORRECTION * jnp.tanh(action)
    hand = jnp.clip(past.hand + change, *REFERENCE_RANGE)
    return past._replace(hand=hand), ramp(past.hand, hand, FRAMES)


def cost(frames: Frames, goal: jax.Array) -> jax.Array:
    """Return the mean distance of the person's end from the goal over a step (n,) [cm]."""
    return jnp.abs(frames.human_end - goal).mean(axis=0) / CENTIMETRE
