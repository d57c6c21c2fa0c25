"""Drawn lifts as arrays: people, plans carried out, sensor noise."""

from collections.abc import Iterable, Sequence
from typing import Any, Final, NamedTuple, TypeVar

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans import Embodied
from colift.agents.humans.following import FOLLOWS_PLAN
from colift.agents.humans.hand import performed
from colift.agents.senses import MOCAP_NOISE
from colift.base.errors import InputError
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seat import HUMANS, body_parameters
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.tasks.level.task import Level
from colift.benchmark.twin.body import CHUNK, DEPTH, Body, bodies
from colift.benchmark.world.interface import HISTORY_FRAMES
from numpy.typing import NDArray

Array = NDArray[np.float64]

MODELLED: Final = ("nao", "human")
"""Holders of the far end that the twin models."""


Many = TypeVar("Many")


class Lifts(NamedTuple):
    """n lifts of at most s steps of f frames, in single precision."""

    reference: jax.Array
    """(s, f, n) height that the person's hand would pull towards without a height error [m]."""
    seen_target: jax.Array
    """(s, n) the intended height one visual delay before the step [m]."""
    noise: jax.Array
    """(s, 2, n) error of the motion capture at either end in the step's sample [m]."""
    latency: jax.Array
    """(n,) age of that sample in frames."""
    steps: jax.Array
    """(n,) length in steps."""
    body: Body
    """The people."""

    @property
    def size(self) -> int:
        """Number of lifts."""
        return self.steps.shape[0]

    def longest(self) -> int:
        """Return the steps of the longest lift."""
        return int(self.reference.shape[0])


def check_modelled(scenario: Scenario) -> None:
    """Check that the twin has all that a scenario needs.

    Raises
    ------
    InputError
        If the task, the holder of the far end, the behaviour or a delay is not modelled.
    """
    if type(scenario.task) is not Level:
        raise InputError(f"the twin models the task level only, not {scenario.task.name!r}")
    if scenario.partner not in MODELLED:
        known = " and ".join(map(repr, MODELLED))
        raise InputError(f"the twin models the partners {known}, not {scenario.partner!r}")
    if scenario.conditions is not None or scenario.rules is not FOLLOWS_PLAN:
        raise InputError(
            f"{scenario.name} has conditions, or people who do not just follow their plan: it "
            "needs the twin with conditions"
        )
    check_people(scenario)


def check_people(scenario: Scenario) -> None:
    """Check that people are scripted, and no older sample is needed than the twin keeps.

    Raises
    ------
    InputError
        If not.
    """
    check_scripted(scenario)
    if scenario.latency_frames >= DEPTH:
        raise InputError(
            f"the twin keeps {DEPTH - 1} frames of the past, a latency of {scenario.latency} s "
            "needs more"
        )


def check_scripted(scenario: Scenario) -> None:
    """Check that people are scripted.

    Raises
    ------
    InputError
        If not.
    """
    if isinstance(scenario.human, Embodied):
        raise InputError(
            f"the twin models scripted people only; {scenario.behaviour!r} brings its own"
        )


def draw_lifts(lifts: Iterable[tuple[Scenario, int]]) -> Lifts:
    """Return the lifts of scenarios and seeds, the same as :class:`.Lift` plays.

    Raises
    ------
    InputError
        If there are no lifts, they have different control periods, or one is not modelled.
    """
    return stack([carried_out(scenario, seed) for scenario, seed in lifts])


class DrawnLift(NamedTuple):
    """One lift in NumPy."""

    scenario: Scenario
    reference: Array
    """(s, f)"""
    target: Array
    """(s, f)"""
    noise: Array
    """(s, 2)"""


def carried_out(scenario: Scenario, seed: int) -> DrawnLift:
    """Return the plan of a lift as its person carries it out, and the noise of its sensors."""
    check_modelled(scenario)
    name, size = scenario.name, scenario.frames_per_step
    plan = scenario.human.plan(scenario.subject, derive_seed(seed, f"plan/{name}"))
    steps = -(-len(plan.target) // size)
    target = np.full(steps * size, plan.target[-1])
    target[: len(plan.target)] = plan.target
    rng = np.random.default_rng(derive_seed(seed, f"sensor/{name}"))
    noise = rng.normal(0.0, MOCAP_NOISE, (2, HISTORY_FRAMES + len(target)))
    sampled = size * np.arange(steps) + HISTORY_FRAMES - 1 - scenario.latency_frames
    hand = performed(scenario.subject, target, derive_seed(seed, f"human/{name}"))
    return DrawnLift(
        scenario,
        hand.reshape(steps, size),
        target.reshape(steps, size),
        noise[:, sampled].T,
    )


def stack(drawn: Sequence[DrawnLift]) -> Lifts:
    """Return lifts, stacked; shorter ones continue at rest.

    Raises
    ------
    InputError
        If there are no lifts, or they have different control periods.
    """
    sizes = {lift.target.shape[1] for lift in drawn}
    if len(sizes) != 1:
        raise InputError(f"the twin needs lifts of one control period, got {len(sizes)}")
    (size,) = sizes
    if size % chunk(size):
        raise InputError(f"the twin cannot divide a step of {size} frames")
    steps = [len(lift.target) for lift in drawn]
    people = [lift.scenario.subject for lift in drawn]
    delays = [round(person.visual_delay / FRAME) for person in people]

    def joined(arrays: Sequence[Array]) -> jax.Array:
        longest = max(steps)
        filled = np.empty((longest, *arrays[0].shape[1:], len(arrays)), jnp.result_type(float))
        for index, array in enumerate(arrays):
            filled[: len(array), ..., index] = array
            filled[len(array) :, ..., index] = array[-1]
        return jnp.asarray(filled)

    return Lifts(
        reference=joined([lift.reference for lift in drawn]),
        seen_target=joined(
            [_seen(lift.target, delay) for lift, delay in zip(drawn, delays, strict=True)]
        ),
        noise=joined([lift.noise for lift in drawn]),
        latency=jnp.asarray([lift.scenario.latency_frames for lift in drawn]),
        steps=jnp.asarray(steps),
        body=bodies([body_parameters(person) for person in people]),
    )


def chunk(size: int) -> int:
    """Return the number of frames in each part of a step of ``size`` frames."""
    return next(many for many in range(CHUNK, 0, -1) if size % many == 0)


def _seen(target: Array, delay: int) -> Array:
    """Return the intended height a delay [frames] before each step (s,); first, that of rest."""
    steps, size = target.shape
    frames = np.arange(steps) * size - 1 - delay
    return np.where(frames >= 0, target.ravel()[np.maximum(frames, 0)], 0.0)


def partner_body(count: int) -> Body:
    """Return the body of the second person of the human-human team, n times."""
    person = HUMANS["human"].person
    return bodies([body_parameters(person)] * count)


def some(lifts: Many, chosen: Any) -> Many:
    """Return the chosen lifts: an index array or a slice of the last axis."""
    taken: Many = jax.tree.map(lambda array: array[..., chosen], lifts)
    return taken
