"""Drawn lifts of the task to find an intended pose, as arrays."""

from collections.abc import Sequence
from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.errors import InputError
from colift.agents.humans.intent import LeadingManner, PosePath, PosePlan, leading_manner
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.tasks.intent.task import Intent
from colift.benchmark.twin.body import Body
from colift.benchmark.twin.columns import LiftSeries, columns
from colift.benchmark.twin.haptic_lifts import (
    Sensed,
    bodies_in_touch,
    common_size,
    draw_sensed,
    joined,
    lengthened,
)
from numpy.typing import NDArray

Array = NDArray[np.float64]


class IntentLifts(NamedTuple):
    """n lifts of at most s steps of f frames, in single precision."""

    near: LiftSeries
    """Planned height of the person's end [m]."""
    far: LiftSeries
    """Planned height of the far end [m]."""
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
    manner: LeadingManner[jax.Array]
    """Their manners; all (n,)."""

    @property
    def size(self) -> int:
        """Number of lifts."""
        return int(self.steps.shape[0])

    @property
    def path(self) -> PosePath[jax.Array]:
        """The plans of both ends."""
        return PosePath(self.near, self.far)


class DrawnIntent(NamedTuple):
    """One lift in NumPy."""

    scenario: Scenario
    near: Array
    far: Array
    sensed: Sensed


def draw_intent(scenario: Scenario, seed: int) -> DrawnIntent:
    """Return the drawn arrays of a lift, the same as :class:`.IntentLift` plays.

    Raises
    ------
    InputError
        If it is another task, or a second person holds the far end.
    """
    if type(scenario.task) is not Intent or scenario.partner != "nao":
        raise InputError(
            f"this twin models the task {Intent.name} with a NAO, not {scenario.task.name!r} with "
            f"{scenario.partner!r}"
        )
    size = scenario.frames_per_step
    plan = scenario.human.plan(scenario.subject, derive_seed(seed, f"plan/{scenario.name}"))
    far = plan.far if isinstance(plan, PosePlan) else plan.target
    steps = -(-len(plan.target) // size)
    return DrawnIntent(
        scenario,
        lengthened(plan.target, steps * size),
        lengthened(far, steps * size),
        draw_sensed(scenario, seed, steps),
    )


def stack_intent(drawn: Sequence[DrawnIntent]) -> IntentLifts:
    """Return lifts of one control period, stacked; shorter ones continue at rest.

    Raises
    ------
    InputError
        If there are no lifts, or they have different control periods.
    """
    size = common_size([lift.scenario.frames_per_step for lift in drawn])
    steps = [len(lift.sensed.gain) for lift in drawn]
    longest = max(steps)
    people = [lift.scenario.subject for lift in drawn]
    return IntentLifts(
        near=LiftSeries.of(joined([lift.near for lift in drawn], longest * size)),
        far=LiftSeries.of(joined([lift.far for lift in drawn], longest * size)),
        gain=joined([lift.sensed.gain for lift in drawn], longest),
        tremor=joined([lift.sensed.tremor for lift in drawn], longest),
        noise=joined([lift.sensed.noise for lift in drawn], longest),
        latency=jnp.asarray([lift.scenario.latency_frames for lift in drawn]),
        steps=jnp.asarray(steps),
        body=bodies_in_touch(people),
        manner=columns([leading_manner(person) for person in people]),
    )
