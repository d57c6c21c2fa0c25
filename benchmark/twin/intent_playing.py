"""The steps of lifts with an intended pose: pace, intention, sensors, frames, score."""

from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.agent import FRAME
from colift.agents.humans.hand import HandMemory
from colift.agents.humans.intent import PaceMemory, PaceSenses, intended, pace
from colift.agents.rules import at_time
from colift.benchmark.episode.seat import REFERENCE_RANGE
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
from colift.benchmark.twin.intent_lifts import IntentLifts
from colift.benchmark.twin.learning_person import Added
from colift.benchmark.twin.playing import Frames
from colift.benchmark.twin.touch_rollout import TouchSteps, mean_error_mm
from colift.benchmark.world.table import TABLE_LENGTH

LOOKS_AHEAD: Final = (10.0, 30.0, 60.0)
"""Frames ahead at which learning people know their intention."""


class IntentState(NamedTuple):
    """The state of n lifts between two steps; histories are (DEPTH, n), newest first."""

    haptic: HapticPlant
    command: jax.Array
    """(n,) command of the far hands [m]."""
    hand: HandMemory[jax.Array]
    """The people's hands."""
    pace: PaceMemory[jax.Array]
    """The people's places within their plans; all (n,)."""
    targets: jax.Array
    """History of the near end's intended height [m]."""
    far_targets: jax.Array
    """History of the far end's intended height [m]."""
    step: jax.Array
    """() number of the coming step."""


def intent_at_rest(count: int) -> IntentState:
    """Return lifts at rest."""
    zero, past = jnp.zeros(count), jnp.zeros((DEPTH, count))
    rest, number = haptic_plant_at_rest(count), jnp.zeros((), jnp.int32)
    return IntentState(rest, zero, hands_at_rest(count), PaceMemory(zero, zero), past, past, number)


class IntentDue(NamedTuple):
    """A step's share of :class:`.IntentLifts`, see there."""

    near: jax.Array
    """(f, n)"""
    far: jax.Array
    """(f, n)"""
    gain: jax.Array
    tremor: jax.Array
    noise: jax.Array


def intent_due(lifts: IntentLifts) -> IntentDue:
    """Return the shares of all steps, with a first axis of steps."""
    near, far = (series.own.reshape(lifts.gain.shape) for series in (lifts.near, lifts.far))
    return IntentDue(near, far, lifts.gain, lifts.tremor, lifts.noise)


def intent_view(state: IntentState, lifts: IntentLifts, due: IntentDue) -> Any:
    """Return the robot's observations (7, n), laid out as :class:`.HapticObservation`."""
    time = state.step * len(due.gain) * FRAME
    return sensed_by_hands(state.haptic, state.command, time, due.noise, lifts.latency)


def intent_known(state: IntentState, lifts: IntentLifts, due: IntentDue) -> jax.Array:
    """Return the knowledge of n people about their intention (6, n).

    The rows are the intended heights of their end at three times ahead, then the intended
    differences of the far end from it.
    """
    ahead = state.pace.time + jnp.asarray(LOOKS_AHEAD)[:, jnp.newaxis]
    near, far = (at_time(LIFTS, series, ahead) for series in lifts.path)
    return jnp.concatenate((10.0 * near, 20.0 * (far - near)))


def intent_step(
    state: IntentState,
    lifts: IntentLifts,
    due: IntentDue,
    action: jax.Array,
    variation: ArmVariation | None = None,
    added: Added | None = None,
) -> tuple[IntentState, Frames]:
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
    plant = state.haptic.plant
    (far_end,) = delayed(plant.heights + plant.differences, body.seen, 1)
    senses = PaceSenses(far_end, delayed(state.far_targets, body.seen, 1)[0])
    memory, times = pace(LIFTS, lifts.manner, state.pace, senses, size)
    pose = intended(LIFTS, lifts.manner, lifts.path, jnp.stack(times), TABLE_LENGTH)
    targets, far_targets, wrist = pose
    hand, references = moved_hand(state, targets, body, due)
    if added is not None:
        references, wrist = references + added.height, wrist + added.pitch
    references = jnp.clip(references, *REFERENCE_RANGE)
    commands = commanded(state.command, action, size)

    meant = Meant(references, far_targets - targets, wrist)
    haptic, near, far = advance_haptic_step(state.haptic, body, meant, commands, variation)
    moved = IntentState(
        haptic=haptic,
        command=commands[-1],
        hand=hand,
        pace=memory,
        targets=pushed(state.targets, targets),
        far_targets=pushed(state.far_targets, far_targets),
        step=state.step + 1,
    )
    return moved, Frames(near, far)


def intent_missed(
    state: IntentState, lifts: IntentLifts, due: IntentDue, frames: Frames
) -> jax.Array:
    """Return the sum of the square distances from the pose in a step (n,), ends averaged [m2]."""
    squares = (frames.human_end - due.near) ** 2 + (frames.robot_end - due.far) ** 2
    return squares.sum(axis=0) / 2 * (state.step < lifts.steps)


INTENT_STEPS: Final = TouchSteps(
    at_rest=intent_at_rest,
    shares=intent_due,
    view=intent_view,
    known=intent_known,
    knows=2 * len(LOOKS_AHEAD),
    step=intent_step,
    missed=intent_missed,
    score_mm=mean_error_mm,
)
"""The steps of the task."""
