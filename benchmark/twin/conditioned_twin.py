"""Lifts of a level table with conditions, as one function of a policy."""

from typing import Any, NamedTuple, cast

import jax
import jax.numpy as jnp
from colift.agents.agent import FRAME, RobotObservation
from colift.agents.humans.hand import HandMemory, HandNoise, carry_out
from colift.benchmark.episode.metrics import FAILED_FRAME_MM
from colift.benchmark.tasks.robust.patient import SLOWS_DOWN
from colift.benchmark.twin.body import DEPTH, pushed
from colift.benchmark.twin.conditioned_lifts import ConditionedLifts
from colift.benchmark.twin.functions import LIFTS
from colift.benchmark.twin.plant import plant_at_rest
from colift.benchmark.twin.playing import LiftState, at_rest, hands_step
from colift.benchmark.twin.rollout import Policy
from colift.benchmark.twin.touch_view import aged
from colift.benchmark.world.interface import HISTORY_FRAMES


class ConditionedState(NamedTuple):
    """The state of n lifts between two steps; histories are newest first."""

    playing: LiftState
    hand: HandMemory[jax.Array]
    """The people's hands."""
    memory: Any
    """The people's memory."""
    targets: jax.Array
    """(DEPTH, n) heights to which the hands went [m]."""
    time: jax.Array
    """(n,) time within the plan, in frames."""
    sight: jax.Array
    """(HISTORY_FRAMES, 2, n) heights of both ends [m]."""


class Share(NamedTuple):
    """A step's share of the noise of lifts."""

    gain: jax.Array
    """(f, n)"""
    tremor: jax.Array
    """(f, n)"""
    errors: jax.Array
    """(2, n)"""
    ages: jax.Array
    """(n,)"""


class ConditionedView:
    """The :class:`.View` of the people in n lifts."""

    def __init__(self, state: ConditionedState, lifts: ConditionedLifts) -> None:
        self._state = state
        self.frame = state.playing.step * lifts.frames
        self.visual, self.haptic = lifts.body.seen, lifts.body.felt
        self.latency = lifts.ages[state.playing.step]
        self.hand, self.command = state.playing.plant.hand, state.playing.command

    def seen(self, name: str, age: Any) -> jax.Array:
        """Return a read-out (n,) of some frames ago; see :meth:`.View.seen`."""
        plant = self._state.playing.plant
        match name:
            case "human_end":
                return aged(plant.heights, age)
            case "robot_end":
                return aged(plant.heights, age) + aged(plant.differences, age)
        return aged(self._state.targets, age)


def conditioned_at_rest(lifts: ConditionedLifts) -> ConditionedState:
    """Return lifts at rest."""
    count = lifts.size
    zero = jnp.zeros(count)
    playing = at_rest(count)._replace(plant=plant_at_rest(count, lifts.body.load))
    return ConditionedState(
        playing,
        HandMemory(zero, zero, zero),
        SLOWS_DOWN.begin(LIFTS, zero, jnp.zeros(count, bool)),
        jnp.zeros((DEPTH, count)),
        zero,
        jnp.zeros((HISTORY_FRAMES, 2, count)),
    )


def observe_conditioned(state: ConditionedState, share: Share, size: int) -> jax.Array:
    """Return the robot's observations (5, n), laid out as :class:`.RobotObservation`."""
    seen = jax.vmap(aged, (1, None))(state.sight, share.ages) + share.errors
    playing = state.playing
    time = jnp.full_like(playing.command, size * FRAME) * playing.step
    return jnp.concatenate((seen, jnp.stack((playing.plant.hand, playing.command, time))))


def conditioned_step(
    state: ConditionedState, lifts: ConditionedLifts, share: Share, action: jax.Array
) -> tuple[ConditionedState, jax.Array]:
    """Return the lifts after a step, and the sums (n,) of squared height differences in it [m2].

    Parameters
    ----------
    state, lifts
        The lifts.
    share
        The step's share of their noise.
    action
        (n,) change of the command [m], clipped to the hands' speed and stroke.
    """
    size, view = lifts.frames, ConditionedView(state, lifts)
    memory, intention = SLOWS_DOWN.intend(LIFTS, lifts.drawn, state.memory, view, size)
    noise = HandNoise(share.gain, share.tremor)
    hand, references = carry_out(LIFTS, state.hand, view, intention.target, noise)
    playing, frames = hands_step(
        state.playing, lifts.body, cast(jax.Array, references), action, lifts.arms
    )
    both = jnp.stack((frames.human_end, frames.robot_end), axis=1)[::-1]
    return ConditionedState(
        playing,
        hand,
        memory,
        pushed(state.targets, intention.target),
        intention.time[-1],
        jnp.concatenate((both, state.sight[: HISTORY_FRAMES - size])),
    ), frames.squares()


def conditioned_rmse_mm(
    policy: Policy,
    memory: Any,
    lifts: ConditionedLifts,
    told: jax.Array | None = None,
    own: jax.Array | None = None,
) -> jax.Array:
    """Return the RMSE (n,) [mm] of lifts with a policy; differentiable.

    Drops of the table are not modelled. The part of a plan that a person who slows down has not
    come to counts as in the engine.

    Parameters
    ----------
    policy, memory
        The policy, and its memory at the beginning.
    lifts
        The lifts.
    told
        (s, k, n) numbers that follow a policy's observation if it is told more; None tells nothing.
    own
        (s, 2, n) error of the observed height and command of the robot's hand [m]; None is none.
    """
    size, count, longest = lifts.frames, lifts.size, len(lifts.gain)
    more = jnp.zeros((longest, 0, count)) if told is None else told
    off = jnp.zeros((longest, 2, count)) if own is None else own

    def step(
        held: tuple[ConditionedState, Any], now: tuple[Share, jax.Array, jax.Array]
    ) -> tuple[tuple[ConditionedState, Any], tuple[jax.Array, jax.Array]]:
        (state, memory), (share, extra, off) = held, now
        view = observe_conditioned(state, share, size)
        hand = slice(RobotObservation.HAND_HEIGHT, RobotObservation.TIME)
        view = jnp.concatenate((view.at[hand].add(off), extra))
        memory, action = policy(memory, view)
        lasts = (state.playing.step < lifts.steps).astype(float)
        state, squares = conditioned_step(state, lifts, share, action)
        return (state, memory), (squares * lasts, state.time)

    begun = (conditioned_at_rest(lifts), memory)
    share = Share(lifts.gain, lifts.tremor, lifts.errors, lifts.ages)
    _, (squares, times) = jax.lax.scan(jax.checkpoint(step), begun, (share, more, off))
    reached = jnp.take_along_axis(times, lifts.steps[jnp.newaxis] - 1, axis=0)[0]
    missing = jnp.maximum(lifts.stop - reached, 0.0)
    total = squares.sum(axis=0) + missing * (FAILED_FRAME_MM / 1000) ** 2
    return 1000 * jnp.sqrt(total / (lifts.steps * size + missing) + 1e-12)
