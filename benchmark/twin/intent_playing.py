"""A step of lifts with an intended pose: pace, intention, sensors, frames; and whole lifts."""

import math
from collections.abc import Callable
from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp

from ...agents.actions import action_limit
from ...agents.agent import FRAME
from ...agents.humans.scripted import CORRECTION_GAIN, CORRECTION_LIMIT, LEAK
from ...agents.intent.pace import CATCHING_UP
from ...robots.nao.kinematics import STROKE
from ..episode.seat import REFERENCE_RANGE
from ..world.table import TABLE_LENGTH
from .arm import ArmVariation
from .body import DEPTH, delayed, pushed
from .haptic_plant import HapticPlant, Meant, advance_haptic_plant, haptic_plant_at_rest
from .intent_lifts import IntentLifts
from .lifts import chunk
from .playing import ramp

LOOKS_AHEAD: Final = (10.0, 30.0, 60.0)
"""Frames ahead at which a learning person knows the own intention."""

ADDED_HEIGHT: Final = 0.02
"""Most that a learning person adds to the height of the hands [m]."""

ADDED_PITCH: Final = 0.1
"""Most that a learning person adds to the pitch that the wrists turn to [rad]."""

_KEPT: Final = math.exp(-FRAME / LEAK)


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
    """(2, n) what a :class:`Person` has added at the end of the last step."""


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


def haptic_view(state: IntentState, noise: jax.Array, latency: jax.Array, period: float) -> Any:
    """Return the robot's observations (7, n), laid out as :class:`.HapticObservation`.

    Parameters
    ----------
    state
        The lifts.
    noise
        (4, n) error of the sensors.
    latency
        (n,) age of the motion capture's sample in frames.
    period
        Control period [s].
    """
    plant = state.haptic.plant
    (human_end,) = delayed(plant.heights, latency, 1)
    robot_end = human_end + delayed(plant.differences, latency, 1)[0]
    force, torque = state.haptic.touch.mean(axis=0)
    time = jnp.full_like(human_end, period) * state.step
    return jnp.stack(
        (
            human_end + noise[0],
            robot_end + noise[1],
            plant.hand,
            state.command,
            time,
            force + noise[2],
            torque + noise[3],
        )
    )


class Person(NamedTuple):
    """A person at the near end who has learned to add to what the hands do by themselves."""

    policy: Callable[[Any, jax.Array], tuple[Any, jax.Array]]
    """Returns memory and additions (2, n), each of at most 1, for a memory and a view (9, n)."""
    memory: Any
    """The memory at the beginning."""


def person_view(state: IntentState, lifts: IntentLifts) -> jax.Array:
    """Return what n persons know (9, n): their senses, as late as they are, and their intention.

    Height of the own end and the difference of the far one, as seen, the felt force, and for three
    times ahead the intended height of the own end and the intended difference of the far one.
    """
    plant, body = state.haptic.plant, lifts.body
    ahead = state.time + jnp.asarray(LOOKS_AHEAD)[:, jnp.newaxis]
    near = planned(lifts.near, ahead)
    seen = (delayed(series, body.seen, 1) for series in (plant.heights, plant.differences))
    felt = delayed(plant.forces, body.felt, 1)
    return jnp.concatenate((*seen, felt, near, planned(lifts.far, ahead) - near))


class IntentFrames(NamedTuple):
    """Heights in the frames of a step, (f, n) [m]."""

    near: jax.Array
    far: jax.Array


def intent_step(
    state: IntentState,
    lifts: IntentLifts,
    gain: jax.Array,
    tremor: jax.Array,
    action: jax.Array,
    variation: ArmVariation | None = None,
    added: jax.Array | None = None,
) -> tuple[IntentState, IntentFrames]:
    """Return the lifts after a step, and the heights in its frames.

    Parameters
    ----------
    state, lifts
        The lifts.
    gain, tremor
        (f, n) the step's share of the hand's noise.
    action
        (n,) change of the command [m], cut to the hands' speed and stroke.
    variation
        Arms that differ from the benchmark's; none: its own.
    added
        (2, n) what a :class:`Person` adds at the end of the step; none: nothing.
    """
    size, body, plant = len(gain), lifts.body, state.haptic.plant
    times = paced(state, lifts, size)
    targets, far_targets = planned(lifts.near, times), planned(lifts.far, times)
    ahead = times + lifts.lead
    sine = (planned(lifts.far, ahead) - planned(lifts.near, ahead)) / TABLE_LENGTH
    wrist = lifts.wrist * sine * (1 + sine**2 / 6)
    before, after = state.added, jnp.zeros_like(state.added) if added is None else added
    hand, turn = (ramp(a, b, size) for a, b in zip(before, after, strict=True))

    missing = (delayed(state.targets, body.seen, 1) - delayed(plant.heights, body.seen, 1))[0]
    wanted = state.correction + CORRECTION_GAIN * missing * size * FRAME
    correction = jnp.clip(wanted, -CORRECTION_LIMIT, CORRECTION_LIMIT)
    changes = jnp.diff(jnp.concatenate((state.targets[:1], targets)), axis=0)

    def erring(error: jax.Array, due: tuple[jax.Array, jax.Array]) -> tuple[jax.Array, jax.Array]:
        error = _KEPT * error + due[0] * due[1]
        return error, error

    error, errors = jax.lax.scan(erring, state.error, (gain, changes))
    references = targets + errors + tremor + ramp(state.correction, correction, size)
    references, wrist = references + ADDED_HEIGHT * hand, wrist + ADDED_PITCH * turn
    references = jnp.clip(references, *REFERENCE_RANGE)
    limit = action_limit(size * FRAME)
    command = jnp.clip(state.command + jnp.clip(action, -limit, limit), *STROKE)
    commands = ramp(state.command, command, size)

    haptic, near, far = state.haptic, [], []
    many = chunk(size)
    for first in range(0, size, many):
        frames = slice(first, first + many)
        meant = Meant(references[frames], (far_targets - targets)[frames], wrist[frames])
        haptic = advance_haptic_plant(haptic, body, meant, commands[frames], variation)
        heights = haptic.plant.heights[:many][::-1]
        near.append(heights)
        far.append(heights + haptic.plant.differences[:many][::-1])
    moved = IntentState(
        haptic=haptic,
        command=command,
        correction=correction,
        error=error,
        time=times[-1],
        targets=pushed(state.targets, targets),
        far_targets=pushed(state.far_targets, far_targets),
        step=state.step + 1,
        added=after,
    )
    return moved, IntentFrames(jnp.concatenate(near), jnp.concatenate(far))


IntentPolicy = Callable[[Any, jax.Array], tuple[Any, jax.Array]]
"""Returns memory and actions (n,) [m] for a memory and observations (7, n)."""


def intent_rmse_mm(
    policy: IntentPolicy,
    memory: Any,
    lifts: IntentLifts,
    variation: ArmVariation | None = None,
    person: Person | None = None,
) -> jax.Array:
    """Return the RMSE of the pose (n,) [mm] of lifts with a policy; differentiable.

    Parameters
    ----------
    policy, memory
        The policy, and its memory at the beginning.
    lifts
        People, plans and noise.
    variation
        Arms that differ from the benchmark's; none: its own.
    person
        A person who has learned; none: the benchmark's.
    """
    longest, size, count = lifts.gain.shape
    plans = (each.reshape(longest, size, count) for each in (lifts.near, lifts.far))

    def step(
        held: tuple[IntentState, Any, Any], now: tuple[jax.Array, ...]
    ) -> tuple[tuple[IntentState, Any, Any], jax.Array]:
        (state, memory, knowing), (gain, tremor, noise, near, far) = held, now
        added = None
        if person is not None:
            knowing, added = person.policy(knowing, person_view(state, lifts))
        view = haptic_view(state, noise, lifts.latency, size * FRAME)
        memory, action = policy(memory, view)
        valid = (state.step < lifts.steps).astype(jnp.float32)
        state, frames = intent_step(state, lifts, gain, tremor, action, variation, added)
        squares = ((frames.near - near) ** 2 + (frames.far - far) ** 2).sum(axis=0) / 2
        return (state, memory, knowing), squares * valid

    _, squares = jax.lax.scan(
        jax.checkpoint(step),
        (intent_at_rest(count), memory, None if person is None else person.memory),
        (lifts.gain, lifts.tremor, lifts.noise, *plans),
    )
    return 1000 * jnp.sqrt(squares.sum(axis=0) / (lifts.steps * size) + 1e-12)
