"""The steps of lifts with two hurdles: people, sensors, frames, score."""

from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.agent import FRAME
from colift.agents.humans.agree.negotiating import (
    Agreeing,
    AgreeingSenses,
    Detour,
    approach,
    beginning,
    common_height,
    negotiate,
    response,
    rests,
)
from colift.agents.humans.agree.precedence import Secret
from colift.agents.humans.hand import HandMemory
from colift.benchmark.episode.seat import REFERENCE_RANGE
from colift.benchmark.twin.agree_lifts import AgreeLifts, Obstacle
from colift.benchmark.twin.arm import ArmVariation
from colift.benchmark.twin.body import DEPTH, delayed, pushed
from colift.benchmark.twin.functions import LIFTS
from colift.benchmark.twin.haptic_plant import (
    HapticPlant,
    Meant,
    advance_haptic_step,
    haptic_plant_at_rest,
)
from colift.benchmark.twin.haptic_playing import (
    commanded,
    hands_at_rest,
    moved_hand,
    sensed_by_hands,
)
from colift.benchmark.twin.learning_person import Added
from colift.benchmark.twin.playing import Frames
from colift.benchmark.twin.touch_rollout import TouchSteps


class AgreeState(NamedTuple):
    """The state of n lifts between two steps."""

    haptic: HapticPlant
    command: jax.Array
    """(n,) command of the far hands [m]."""
    hand: HandMemory[jax.Array]
    """The people's hands."""
    agreeing: Agreeing[jax.Array]
    """What the people keep."""
    detour: Detour[jax.Array]
    """Their hands' distances from the common way."""
    targets: jax.Array
    """(DEPTH, n) history of the hand's intended height [m], newest first."""
    step: jax.Array
    """() number of the coming step."""


def agree_at_rest(count: int) -> AgreeState:
    """Return lifts at rest."""
    zero, past = jnp.zeros(count), jnp.zeros((DEPTH, count))
    rest, number = haptic_plant_at_rest(count), jnp.zeros((), jnp.int32)
    return AgreeState(
        haptic=rest,
        command=zero,
        hand=hands_at_rest(count),
        agreeing=beginning(LIFTS, zero, jnp.zeros(count, bool)),
        detour=Detour(zero, zero),
        targets=past,
        step=number,
    )


class AgreeDue(NamedTuple):
    """A step's share of :class:`.AgreeLifts`, see there."""

    way: jax.Array
    times: jax.Array
    sight: jax.Array
    shown: jax.Array
    gain: jax.Array
    tremor: jax.Array
    noise: jax.Array


def agree_due(lifts: AgreeLifts) -> AgreeDue:
    """Return the shares of all steps, with a first axis of steps."""
    return AgreeDue(
        lifts.target,
        lifts.times,
        lifts.sight,
        lifts.shown,
        lifts.gain,
        lifts.tremor,
        lifts.noise,
    )


def agree_view(state: AgreeState, lifts: AgreeLifts, due: AgreeDue) -> jax.Array:
    """Return the robot's observations (11, n), laid out as :class:`.AgreeObservation`."""
    time = state.step * len(due.gain) * FRAME
    touch = sensed_by_hands(state.haptic, state.command, time, due.noise, lifts.latency)
    return jnp.concatenate((touch, due.shown))


def agree_known(state: AgreeState, lifts: AgreeLifts, due: AgreeDue) -> jax.Array:
    """Return the knowledge of n people about their hurdle (5, n).

    The rows are the common height while the way rests there, the height of the person's hurdle, the
    times until its window opens and closes, and whether there is a hurdle.
    """
    own = lifts.human
    common = common_height(LIFTS, state.agreeing.common, resting(due), due.way[-1])
    heights = jnp.stack((10.0 * common, 10.0 * own.height))
    return jnp.concatenate((heights, 0.5 * due.times, own.given[jnp.newaxis]))


def resting(due: AgreeDue) -> Any:
    """Return whether the common way rests above the ground in a step (n,)."""
    return rests(LIFTS, due.way[0], due.way[-1], len(due.way))


def negotiated(
    state: AgreeState, lifts: AgreeLifts, due: AgreeDue
) -> tuple[Agreeing[jax.Array], Detour[jax.Array], jax.Array]:
    """Return people after a step, their detours, and the hands' intended heights (f, n) [m].

    Decisions are made in single precision and have no gradient: a loss depends on a person's
    actions, not on how close a decision was.
    """
    plant, body, size = state.haptic.plant, lifts.body, len(due.way)
    (then,) = delayed(plant.heights, body.seen, 1)
    senses = AgreeingSenses(
        own=plant.heights[0],
        then=then,
        far=then + delayed(plant.differences, body.seen, 1)[0],
        sight=due.sight,
        uncertainty=lifts.uncertainty,
    )
    hurdle = Secret(lifts.human.height, due.times[0], due.times[1], lifts.human.given)
    still, last = resting(due), due.way[-1]
    agreeing, goes = negotiate(
        LIFTS, lifts.manner, state.agreeing, senses, hurdle, still, last, size * FRAME
    )
    wanted = response(LIFTS, lifts.manner, agreeing, hurdle, goes)
    aim = jnp.where(still, wanted - last, 0.0)
    detour, heights = approach(LIFTS, state.detour, aim, due.way)
    return agreeing, detour, heights


def agree_step(
    state: AgreeState,
    lifts: AgreeLifts,
    due: AgreeDue,
    action: jax.Array,
    variation: ArmVariation | None = None,
    added: Added | None = None,
) -> tuple[AgreeState, Frames]:
    """Return the lifts after a step, and the heights in its frames.

    Parameters
    ----------
    state, lifts
        The lifts.
    due
        The step's share of them.
    action
        (n,) change of the command [m], clipped to the hands' speed and stroke.
    variation
        Variation of the arms; None is the benchmark's arms.
    added
        Additions by learning people; None adds nothing.
    """
    size, body = len(due.gain), lifts.body
    agreeing, detour, targets = negotiated(state, lifts, due)
    hand, references = moved_hand(state, targets, body, due)
    level = wrist = jnp.zeros_like(references)
    if added is not None:
        references, wrist = references + added.height, added.pitch
    references = jnp.clip(references, *REFERENCE_RANGE)
    commands = commanded(state.command, action, size)
    meant = Meant(references, level, wrist)
    haptic, near, far = advance_haptic_step(state.haptic, body, meant, commands, variation)
    after = AgreeState(
        haptic=haptic,
        command=commands[-1],
        hand=hand,
        agreeing=agreeing,
        detour=detour,
        targets=pushed(state.targets, targets),
        step=state.step + 1,
    )
    return after, Frames(near, far)


class AgreeSquares(NamedTuple):
    """Contribution of a step to the score of n lifts, all (n,) [m2]."""

    human: jax.Array
    """Least square distance of the table from the human's hurdle in its window."""
    robot: jax.Array
    """Least square distance of the table from the robot's hurdle in its window."""
    level: jax.Array
    """Sum of the squared height differences at the common height."""


def _passing(hurdle: Obstacle, frames: Frames, numbers: jax.Array) -> jax.Array:
    """Return the least square distance (n,) [m2]; 1 if no frame of the step is in the window."""
    ends = (frames.human_end - hurdle.height) ** 2 + (frames.robot_end - hurdle.height) ** 2
    within = (hurdle.start <= numbers) & (numbers < hurdle.stop)
    return jnp.where(within, ends / 2, 1.0).min(axis=0)


def agree_missed(
    state: AgreeState, lifts: AgreeLifts, due: AgreeDue, frames: Frames
) -> AgreeSquares:
    """Return the contribution of a step to the score, from the state before it and its frames.

    The gradient of a missed hurdle is that of the frame in which the table comes nearest.
    """
    size = len(frames.human_end)
    numbers = (state.step * size + jnp.arange(size))[:, jnp.newaxis]
    first, past = lifts.agreeing
    held = ((first <= numbers) & (numbers < past)).astype(jnp.float32)
    return AgreeSquares(
        _passing(lifts.human, frames, numbers),
        _passing(lifts.robot, frames, numbers),
        (held * (frames.human_end - frames.robot_end) ** 2).sum(axis=0),
    )


def agree_score_mm(lifts: AgreeLifts, squares: AgreeSquares) -> jax.Array:
    """Return the RMSE of the agreement (n,) [mm] of lifts from the squares of all steps (s, n)."""
    given = lifts.human.given, lifts.robot.given
    missed = given[0] * squares.human.min(axis=0) + given[1] * squares.robot.min(axis=0)
    level = squares.level.sum(axis=0) / (lifts.agreeing[1] - lifts.agreeing[0])
    return 1000 * jnp.sqrt((missed + level) / (1 + given[0] + given[1]) + 1e-12)


AGREE_STEPS: Final = TouchSteps(
    at_rest=agree_at_rest,
    shares=agree_due,
    view=agree_view,
    known=agree_known,
    knows=5,
    step=agree_step,
    missed=agree_missed,
    score_mm=agree_score_mm,
)
"""The steps of the task."""
