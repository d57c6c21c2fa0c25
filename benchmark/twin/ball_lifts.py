"""Drawn lifts of the task to steer a ball, as arrays."""

from collections.abc import Sequence
from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.agent import HISTORY
from colift.agents.errors import InputError
from colift.agents.humans.ball import BallPlan, SteeringManner, steering_manner
from colift.benchmark.episode.lift import MOCAP_NOISE
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.tasks.ball.task import BALL, BallSteering
from colift.benchmark.twin.body import Body
from colift.benchmark.twin.columns import columns
from colift.benchmark.twin.haptic_lifts import (
    Sensed,
    bodies_in_touch,
    common_size,
    draw_sensed,
    joined,
    lengthened,
    sampled_frames,
)
from colift.benchmark.world.world import HISTORY_FRAMES
from numpy.typing import NDArray

Array = NDArray[np.float64]


class BallLifts(NamedTuple):
    """n lifts of at most s steps of f frames, in single precision."""

    target: jax.Array
    """(s, f, n) planned height of the person's end at the end of each frame [m]."""
    place: jax.Array
    """(s, f, n) intended place of the ball at the end of each frame [m]."""
    coming: jax.Array
    """(s, HISTORY, n) the same for the first ten frames from the beginning of each step."""
    gain: jax.Array
    """(s, f, n) signal-dependent noise of the person's hand, relative to its velocity."""
    tremor: jax.Array
    """(s, f, n) tremor of the hand [m]."""
    noise: jax.Array
    """(s, 5, n) error of the motion capture at either end [m], of force [N] and torque [Nm], and of
    the ball's place [m]."""
    latency: jax.Array
    """(n,) age of the motion capture's sample in frames."""
    steps: jax.Array
    """(n,) length in steps."""
    shown: jax.Array
    """(n,) 1 if the robot knows the target, else 0."""
    body: Body
    """The people."""
    manner: SteeringManner[jax.Array]
    """Their manners of steering; all (n,)."""

    @property
    def size(self) -> int:
        """Number of lifts."""
        return int(self.steps.shape[0])


class DrawnBall(NamedTuple):
    """One lift in NumPy."""

    scenario: Scenario
    target: Array
    place: Array
    coming: Array
    noise: Array
    sensed: Sensed
    shown: bool


def draw_ball(scenario: Scenario, seed: int) -> DrawnBall:
    """Return the drawn arrays of a lift, the same as :class:`.BallLift` plays.

    Raises
    ------
    InputError
        If it is another task or ball, or a second person holds the far end.
    """
    task = scenario.task
    if type(task) is not BallSteering or task.ball != BALL or scenario.partner != "nao":
        raise InputError(
            f"this twin models the task {BallSteering.name} with a NAO, not {task.name!r} with "
            f"{scenario.partner!r}"
        )
    name, size = scenario.name, scenario.frames_per_step
    plan = scenario.human.plan(scenario.subject, derive_seed(seed, f"plan/{name}"))
    steps = -(-len(plan.target) // size)
    frames = steps * size
    place = plan.place if isinstance(plan, BallPlan) else np.zeros(1)
    later = lengthened(place, frames + HISTORY)
    first = size * np.arange(steps)
    rng = np.random.default_rng(derive_seed(seed, f"ball sensor/{name}"))
    seen = rng.normal(0.0, MOCAP_NOISE, HISTORY_FRAMES + frames)
    sensed = draw_sensed(scenario, seed, steps)
    return DrawnBall(
        scenario,
        lengthened(plan.target, frames).reshape(steps, size),
        later[:frames].reshape(steps, size),
        later[first[:, np.newaxis] + np.arange(HISTORY)],
        np.column_stack((sensed.noise, seen[sampled_frames(scenario, steps)])),
        sensed,
        isinstance(plan, BallPlan) and plan.shown,
    )


def stack_ball(drawn: Sequence[DrawnBall]) -> BallLifts:
    """Return lifts of one control period, stacked; shorter ones continue at rest.

    Raises
    ------
    InputError
        If there are no lifts, or they have different control periods.
    """
    common_size([lift.scenario.frames_per_step for lift in drawn])
    steps = [len(lift.target) for lift in drawn]
    longest = max(steps)
    people = [lift.scenario.subject for lift in drawn]
    return BallLifts(
        target=joined([lift.target for lift in drawn], longest),
        place=joined([lift.place for lift in drawn], longest),
        coming=joined([lift.coming for lift in drawn], longest),
        gain=joined([lift.sensed.gain for lift in drawn], longest),
        tremor=joined([lift.sensed.tremor for lift in drawn], longest),
        noise=joined([lift.noise for lift in drawn], longest),
        latency=jnp.asarray([lift.scenario.latency_frames for lift in drawn]),
        steps=jnp.asarray(steps),
        shown=jnp.asarray([lift.shown for lift in drawn], jnp.float32),
        body=bodies_in_touch(people),
        manner=columns([steering_manner(person) for person in people]),
    )
