"""A step of lifts with an intended pose: pace, intention, frames."""

from typing import Final, NamedTuple

import jax
import jax.numpy as jnp

from ...agents.intent.pace import CATCHING_UP
from ..episode.seat import REFERENCE_RANGE
from ..world.table import TABLE_LENGTH
from .arm import ArmVariation
from .body import DEPTH, delayed, pushed
from .haptic_plant import HapticPlant, Meant, advance_haptic_step, haptic_plant_at_rest
from .haptic_playing import commanded, moved_hand
from .intent_lifts import IntentLifts
from .playing import Frames, ramp

ADDED_HEIGHT: Final = 0.02
"""Most that a learning person adds to the height of the hands [m]."""

ADDED_PITCH: Final = 0.1
"""Most that a learning person adds to the pitch that the wrists turn to [rad]."""


class IntentState(NamedTuple):
    """The state of n lifts between two steps; histories are (DEPTH, n), newest first."""

    haptic: HapticPlant
    command: jax.Array
    """(n,) command of the far hands [m]."""
    correction: jax.Array
    """(n,) the person's voluntary correction [m]."""
    error: jax.Array
    """(n,) error of the hand by motor noise [m]."""
    time: jax.Array
    """(n,) time within the plan, in frames."""
    targets: jax.Array
    """History of the near end's intended height [m]."""
    far_targets: jax.Array
    """History of the far end's intended height [m]."""
    step: jax.Array
    """() number of the coming step."""
    added: jax.Array
    """(2, n) what a :class:`.LearningPerson` has added at the end of the last step."""


def intent_at_rest(count: int) -> IntentState:
    """Return lifts at rest."""
    zero, past = jnp.zeros(count), jnp.zeros((DEPTH, count))
    rest, added = haptic_plant_at_rest(count), jnp.zeros((2, count))
    return IntentState(rest, zero, zero, zero, zero, past, past, jnp.zeros((), jnp.int32), added)


def planned(series: jax.Array, time: jax.Array) -> jax.Array:
    """Return a plan's heights (f, n) of (T, n) at times in frames (f, n), as ``planned_at``."""
    place = jnp.clip(time - 1.0, -1.0, len(series) - 1.0)
    below = jnp.floor(jax.lax.stop_gradient(place)).astype(jnp.int32)
    padded = jnp.concatenate((jnp.zeros((1, series.shape[1])), series, series[-1:]))
    low = jnp.take_along_axis(padded, below + 1, axis=0)
    high = jnp.take_along_axis(padded, below + 2, axis=0)
    return low + (place - below) * (high - low)


def paced(state: IntentState, lifts: IntentLifts, size: int) -> jax.Array:
    """Return the times within the plan at the end of each frame of a step (f, n); see Pace."""
    plant = state.haptic.plant
    far_end = plant.heights + plant.differences
    seen = lifts.body.seen
    away = jnp.abs(delayed(far_end, seen, 1) - delayed(state.far_targets, seen, 1))[0]
    pace = jnp.clip(2.0 - away / lifts.patience, 0.0, 1.0)
    late = state.step * size - state.time
    hurried = jnp.minimum(pace * CATCHING_UP, pace + late / size)
    pace = jnp.where(late > 0.0, hurried, pace)
    return state.time + pace * jnp.arange(1, size + 1, dtype=jnp.float32)[:, jnp.newaxis]


class IntentDue(NamedTuple):
    """A step's share of :class:`.IntentLifts`, see there."""

    gain: jax.Array
    tremor: jax.Array


def intent_step(
    state: IntentState,
    lifts: IntentLifts,
    due: IntentDue,
    action: jax.Array,
    variation: ArmVariation | None = None,
    added: jax.Array | None = None,
) -> tuple[IntentState, Frames]:
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
    added
        (2, n) what a :class:`.LearningPerson` adds at the end of the step; none: nothing.
    """
    size, body, plant = len(due.gain), lifts.body, state.haptic.plant
    times = paced(state, lifts, size)
    targets, far_targets = planned(lifts.near, times), planned(lifts.far, times)
    ahead = times + lifts.lead
    sine = (planned(lifts.far, ahead) - planned(lifts.near, ahead)) / TABLE_LENGTH
    wrist = lifts.wrist * sine * (1 + sine**2 / 6)
    before, after = state.added, jnp.zeros_like(state.added) if added is None else added
    shift, turn = (ramp(a, b, size) for a, b in zip(before, after, strict=True))

    hand = moved_hand(state, targets, plant.heights, body, due)
    references = jnp.clip(hand.references + ADDED_HEIGHT * shift, *REFERENCE_RANGE)
    wrist = wrist + ADDED_PITCH * turn
    commands = commanded(state.command, action, size)

    meant = Meant(references, far_targets - targets, wrist)
    haptic, near, far = advance_haptic_step(state.haptic, body, meant, commands, variation)
    moved = IntentState(
        haptic=haptic,
        command=commands[-1],
        correction=hand.correction,
        error=hand.error,
        time=times[-1],
        targets=pushed(state.targets, targets),
        far_targets=pushed(state.far_targets, far_targets),
        step=state.step + 1,
        added=after,
    )
    return moved, Frames(near, far)
