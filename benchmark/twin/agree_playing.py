"""A step of lifts with two hurdles: people, sensors, frames; and whole lifts."""

from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from ...agents.agent import FRAME
from ..episode.seat import REFERENCE_RANGE
from .agree_lifts import AgreeLifts, Obstacle
from .agree_people import AgreeMind, AgreeSight, agree_minds, negotiated
from .arm import ArmVariation
from .body import DEPTH, pushed
from .haptic_plant import HapticPlant, Meant, advance_haptic_step, haptic_plant_at_rest
from .haptic_playing import commanded, moved_hand, sensed_by_hands
from .playing import Frames
from .rollout import Policy


class AgreeState(NamedTuple):
    """The state of n lifts between two steps."""

    haptic: HapticPlant
    command: jax.Array
    """(n,) command of the far hands [m]."""
    correction: jax.Array
    """(n,) the person's voluntary correction [m]."""
    error: jax.Array
    """(n,) error of the hand by motor noise [m]."""
    mind: AgreeMind
    """The people."""
    targets: jax.Array
    """(DEPTH, n) history of the height that the hand meant to have [m], newest first."""
    step: jax.Array
    """() number of the coming step."""


def agree_at_rest(count: int) -> AgreeState:
    """Return lifts at rest."""
    zero, past = jnp.zeros(count), jnp.zeros((DEPTH, count))
    rest, number = haptic_plant_at_rest(count), jnp.zeros((), jnp.int32)
    return AgreeState(rest, zero, zero, zero, agree_minds(count), past, number)


class AgreeDue(NamedTuple):
    """A step's share of :class:`.AgreeLifts`, see there."""

    sight: AgreeSight
    shown: jax.Array
    gain: jax.Array
    tremor: jax.Array
    noise: jax.Array


def agree_due(lifts: AgreeLifts) -> AgreeDue:
    """Return the shares of all steps, with a first axis of steps."""
    sight = AgreeSight(lifts.target, lifts.common, lifts.times, lifts.sight)
    return AgreeDue(sight, lifts.shown, lifts.gain, lifts.tremor, lifts.noise)


def agree_view(state: AgreeState, lifts: AgreeLifts, due: AgreeDue) -> jax.Array:
    """Return the robot's observations (11, n), laid out as :class:`.AgreeObservation`."""
    time = state.step * len(due.gain) * FRAME
    touch = sensed_by_hands(state.haptic, state.command, time, due.noise, lifts.latency)
    return jnp.concatenate((touch, due.shown))


def agree_step(
    state: AgreeState,
    lifts: AgreeLifts,
    due: AgreeDue,
    action: jax.Array,
    variation: ArmVariation | None = None,
) -> tuple[AgreeState, Frames]:
    """Return the lifts after a step, and the heights in its frames.

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
    size, body, plant = len(due.gain), lifts.body, state.haptic.plant
    mind, targets = negotiated(state.mind, lifts, due.sight, plant)
    hand = moved_hand(state, targets, plant.heights, body, due)
    references = jnp.clip(hand.references, *REFERENCE_RANGE)
    commands = commanded(state.command, action, size)
    level = jnp.zeros_like(references)
    meant = Meant(references, level, level)
    haptic, near, far = advance_haptic_step(state.haptic, body, meant, commands, variation)
    after = AgreeState(
        haptic=haptic,
        command=commands[-1],
        correction=hand.correction,
        error=hand.error,
        mind=mind,
        targets=pushed(state.targets, targets),
        step=state.step + 1,
    )
    return after, Frames(near, far)


class AgreeSquares(NamedTuple):
    """What a step adds to the score of n lifts, all (n,) [m2]."""

    human: jax.Array
    """Least square distance of the table from the human's hurdle in its window."""
    robot: jax.Array
    """The same of the robot's."""
    level: jax.Array
    """Sum of the squared height differences at the common height."""


def _passing(hurdle: Obstacle, frames: Frames, numbers: jax.Array) -> jax.Array:
    """Return the least square distance (n,) [m2]; 1 if no frame of the step is in the window."""
    ends = (frames.human_end - hurdle.height) ** 2 + (frames.robot_end - hurdle.height) ** 2
    within = (hurdle.start <= numbers) & (numbers < hurdle.stop)
    return jnp.where(within, ends / 2, 1.0).min(axis=0)


def agree_squares(lifts: AgreeLifts, frames: Frames, step: jax.Array) -> AgreeSquares:
    """Return what the step of this number, of which these are the frames, adds to the score."""
    size = len(frames.human_end)
    numbers = (step * size + jnp.arange(size))[:, jnp.newaxis]
    first, past = lifts.agreeing
    held = ((first <= numbers) & (numbers < past)).astype(jnp.float32)
    return AgreeSquares(
        _passing(lifts.human, frames, numbers),
        _passing(lifts.robot, frames, numbers),
        (held * (frames.human_end - frames.robot_end) ** 2).sum(axis=0),
    )


def agree_score_mm(lifts: AgreeLifts, squares: AgreeSquares) -> jax.Array:
    """Return the RMSE of the agreement (n,) [mm] of lifts by the squares of all steps (s, n)."""
    given = lifts.human.given, lifts.robot.given
    missed = given[0] * squares.human.min(axis=0) + given[1] * squares.robot.min(axis=0)
    level = squares.level.sum(axis=0) / (lifts.agreeing[1] - lifts.agreeing[0])
    return 1000 * jnp.sqrt((missed + level) / (1 + given[0] + given[1]) + 1e-12)


def agree_rmse_mm(
    policy: Policy, memory: Any, lifts: AgreeLifts, variation: ArmVariation | None = None
) -> jax.Array:
    """Return the RMSE of the agreement (n,) [mm] of lifts with a policy; differentiable.

    The gradient of a missed hurdle is that of the frame in which the table comes nearest. A table
    that is dropped is not modelled.

    Parameters
    ----------
    policy, memory
        The policy, and its memory at the beginning.
    lifts
        People, plans and noise.
    variation
        Arms that differ from the benchmark's; none: its own.
    """

    def step(
        held: tuple[AgreeState, Any], due: AgreeDue
    ) -> tuple[tuple[AgreeState, Any], AgreeSquares]:
        state, memory = held
        memory, action = policy(memory, agree_view(state, lifts, due))
        after, frames = agree_step(state, lifts, due, action, variation)
        return (after, memory), agree_squares(lifts, frames, state.step)

    _, squares = jax.lax.scan(
        jax.checkpoint(step), (agree_at_rest(lifts.size), memory), agree_due(lifts)
    )
    return agree_score_mm(lifts, squares)
