"""Drawn lifts of the task to find an intended pose, as arrays."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from numpy.typing import NDArray

from ...agents.agent import FRAME
from ...agents.errors import InputError
from ...agents.humans import ScriptedHuman
from ...agents.humans.scripted import LEAK
from ...agents.intent import PosePlan, leading_manner
from ..episode.lift import MOCAP_NOISE
from ..episode.scenario import Scenario
from ..episode.seat import body_parameters
from ..episode.seeding import derive_seed
from ..tasks.haptic import FORCE_NOISE, TORQUE_NOISE
from ..tasks.intent.task import Intent
from ..world.world import HISTORY_FRAMES
from .body import Body, bodies
from .lifts import hand_references

Array = NDArray[np.float64]


class IntentLifts(NamedTuple):
    """n lifts of at most s steps of f frames, in single precision."""

    near: jax.Array
    """(s f, n) planned height of the person's end at the end of each frame [m]."""
    far: jax.Array
    """(s f, n) planned height of the far end [m]."""
    gain: jax.Array
    """(s, f, n) signal-dependent noise of the person's hand, relative to its velocity."""
    tremor: jax.Array
    """(s, f, n) tremor of the hand [m]."""
    noise: jax.Array
    """(s, 4, n) error of the motion capture at either end [m], of force [N] and torque [Nm]."""
    latency: jax.Array
    """(n,) age of the motion capture's sample in frames."""
    steps: jax.Array
    """(n,) length in steps."""
    body: Body
    """The people."""
    wrist: jax.Array
    """(n,) share of the intended pitch that the wrists show."""
    lead: jax.Array
    """(n,) how far they are ahead, in frames."""
    patience: jax.Array
    """(n,) see :class:`.LeadingManner` [m]."""

    @property
    def size(self) -> int:
        """How many lifts."""
        return int(self.steps.shape[0])


class DrawnIntent(NamedTuple):
    """One lift in NumPy."""

    scenario: Scenario
    near: Array
    far: Array
    gain: Array
    tremor: Array
    noise: Array


def draw_intent(scenario: Scenario, seed: int) -> DrawnIntent:
    """Return what is drawn for a lift: the same as :class:`.IntentLift` plays.

    Raises
    ------
    InputError
        If the task is another, or a second person holds the far end.
    """
    if type(scenario.task) is not Intent or scenario.partner != "nao":
        raise InputError(
            f"this twin has the task {Intent.name} with a NAO, not {scenario.task.name!r} with "
            f"{scenario.partner!r}"
        )
    name, size, subject = scenario.name, scenario.frames_per_step, scenario.subject
    plan = scenario.human.plan(subject, derive_seed(seed, f"plan/{name}"))
    far = plan.far if isinstance(plan, PosePlan) else plan.target
    steps = -(-len(plan.target) // size)
    frames = steps * size
    rng = np.random.default_rng(derive_seed(seed, f"sensor/{name}"))
    mocap = rng.normal(0.0, MOCAP_NOISE, (2, HISTORY_FRAMES + frames))
    sampled = size * np.arange(steps) + HISTORY_FRAMES - 1 - scenario.latency_frames
    rng = np.random.default_rng(derive_seed(seed, f"force sensor/{name}"))
    touch = rng.normal(0.0, 1.0, (2, steps + 1))[:, :steps]
    touch = touch * np.array([[FORCE_NOISE], [TORQUE_NOISE]])
    gain, tremor = _hand_noise(scenario, seed, frames)
    return DrawnIntent(
        scenario,
        _lengthened(plan.target, frames),
        _lengthened(far, frames),
        gain.reshape(steps, size),
        tremor.reshape(steps, size),
        np.concatenate((mocap[:, sampled], touch)).T,
    )


def _hand_noise(scenario: Scenario, seed: int, frames: int) -> tuple[Array, Array]:
    """Return gain and tremor of a person's hand (frames,), from what it does.

    One that is to stay shows the tremor alone. One that is to move by 1 m in each frame shows
    errors e, too, of which those of the last frame are kept in part: g_i = e_i - kept e_(i-1).
    """
    size = scenario.frames_per_step
    ramp = np.arange(1.0, frames + 1)
    tremor, moving = (
        hand_references(_hand(scenario, seed), target, size).ravel()
        for target in (np.zeros(frames), ramp)
    )
    error = moving - ramp - tremor
    kept = math.exp(-FRAME / LEAK)
    return error - kept * np.concatenate(([0.0], error[:-1])), tremor


def _hand(scenario: Scenario, seed: int) -> ScriptedHuman:
    hand = ScriptedHuman(subject=scenario.subject)
    hand.reset(derive_seed(seed, f"human/{scenario.name}"))
    return hand


def stack_intent(drawn: Sequence[DrawnIntent]) -> IntentLifts:
    """Return lifts of one control period in one; shorter ones go on at rest.

    Raises
    ------
    InputError
        If there is none, or they have different control periods.
    """
    sizes = {lift.gain.shape[1] for lift in drawn}
    if len(sizes) != 1:
        raise InputError(f"the twin needs lifts of one control period, got {len(sizes)}")
    (size,) = sizes
    steps = [len(lift.gain) for lift in drawn]
    longest = max(steps)
    people = [lift.scenario.subject for lift in drawn]
    manners = [leading_manner(person) for person in people]

    def joined(arrays: Sequence[Array], many: int) -> jax.Array:
        filled = np.empty((many, *arrays[0].shape[1:], len(arrays)), np.float32)
        for index, array in enumerate(arrays):
            filled[: len(array), ..., index] = array
            filled[len(array) :, ..., index] = array[-1]
        return jnp.asarray(filled)

    return IntentLifts(
        near=joined([lift.near for lift in drawn], longest * size),
        far=joined([lift.far for lift in drawn], longest * size),
        gain=joined([lift.gain for lift in drawn], longest),
        tremor=joined([lift.tremor for lift in drawn], longest),
        noise=joined([lift.noise for lift in drawn], longest),
        latency=jnp.asarray([lift.scenario.latency_frames for lift in drawn]),
        steps=jnp.asarray(steps),
        body=bodies([body_parameters(person) for person in people]),
        wrist=jnp.asarray([manner.wrist for manner in manners], jnp.float32),
        lead=jnp.asarray([manner.lead / FRAME for manner in manners], jnp.float32),
        patience=jnp.asarray([manner.patience for manner in manners], jnp.float32),
    )


def _lengthened(heights: Array, frames: int) -> Array:
    return np.concatenate((heights, np.full(frames - len(heights), heights[-1])))
