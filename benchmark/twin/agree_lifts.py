"""Drawn lifts of the task to agree on two hurdles, as arrays."""

from collections.abc import Sequence
from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.agent import FRAME
from colift.agents.errors import InputError
from colift.agents.humans.agree import AgreeingManner, Hurdle, HurdlePlan, agreeing_manner
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.tasks.agree.task import Agree
from colift.benchmark.twin.body import Body
from colift.benchmark.twin.columns import columns
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


class Obstacle(NamedTuple):
    """The hurdle of one end in n lifts, all (n,); without one all are 0."""

    height: jax.Array
    """[m]"""
    start: jax.Array
    """First frame of its window."""
    stop: jax.Array
    """Frame after its last."""
    given: jax.Array
    """1 if there is a hurdle."""


class AgreeLifts(NamedTuple):
    """n lifts of at most s steps of f frames, in single precision."""

    target: jax.Array
    """(s, f, n) height of the common way at the end of each frame [m]."""
    times: jax.Array
    """(s, 2, n) times from the beginning of each step until the human's window opens and closes
    [s]."""
    shown: jax.Array
    """(s, 4, n) the robot's hurdle as the robot knows it, see :class:`.Secret`."""
    gain: jax.Array
    """(s, f, n) signal-dependent noise of the person's hand, relative to its velocity."""
    tremor: jax.Array
    """(s, f, n) tremor of the hand [m]."""
    noise: jax.Array
    """(s, 4, n) error of the motion capture at either end [m], of force [N] and torque [Nm]."""
    sight: jax.Array
    """(s, n) error of the far end's speed as the person perceives it [m/s]."""
    uncertainty: jax.Array
    """(n,) standard deviation of that error [m/s]."""
    latency: jax.Array
    """(n,) age of the motion capture's sample in frames."""
    steps: jax.Array
    """(n,) length in steps."""
    human: Obstacle
    """The human's hurdle."""
    robot: Obstacle
    """The robot's hurdle."""
    agreeing: jax.Array
    """(2, n) first frame at the common height, and frame after the last."""
    body: Body
    """The people."""
    manner: AgreeingManner[jax.Array]
    """Their manners; all (n,)."""

    @property
    def size(self) -> int:
        """Number of lifts."""
        return int(self.steps.shape[0])


class DrawnAgree(NamedTuple):
    """One lift in NumPy."""

    scenario: Scenario
    target: Array
    times: Array
    shown: Array
    sight: Array
    sensed: Sensed
    human: Hurdle | None
    robot: Hurdle | None
    agreeing: tuple[int, int]
    uncertainty: float


def draw_agree(scenario: Scenario, seed: int) -> DrawnAgree:
    """Return the drawn arrays of a lift, the same as :class:`.AgreeLift` plays.

    Raises
    ------
    InputError
        If it is another task, or a second person holds the far end.
    """
    task = scenario.task
    if type(task) is not Agree or scenario.partner != "nao":
        raise InputError(
            f"this twin models the task {Agree.name} with a NAO, not {task.name!r} with "
            f"{scenario.partner!r}"
        )
    name, size = scenario.name, scenario.frames_per_step
    plan = scenario.human.plan(scenario.subject, derive_seed(seed, f"plan/{name}"))
    steps = -(-len(plan.target) // size)
    human, robot, agreeing = None, None, (0, steps * size)
    if isinstance(plan, HurdlePlan):
        human, robot, agreeing = plan.own, plan.other, plan.agreeing
    target = lengthened(plan.target, steps * size).reshape(steps, size)
    rng = np.random.default_rng((derive_seed(seed, f"human/{name}"), 1))
    shown = np.zeros((steps, 4))
    if robot is not None:
        shown[:, 0], shown[:, 3] = robot.height, 1.0
        shown[:, 1:3] = _until(robot, steps, size)
    return DrawnAgree(
        scenario,
        target,
        _until(human, steps, size),
        shown,
        task.uncertainty * rng.standard_normal(steps),
        draw_sensed(scenario, seed, steps),
        human,
        robot,
        agreeing,
        task.uncertainty,
    )


def _until(hurdle: Hurdle | None, steps: int, size: int) -> Array:
    """Return the times until a window opens and closes (s, 2) [s]."""
    frames = np.zeros(2) if hurdle is None else np.array((hurdle.start, hurdle.stop))
    passed = size * np.arange(steps) if hurdle is not None else np.zeros(steps)
    return (frames - passed[:, np.newaxis]) * FRAME


def stack_agree(drawn: Sequence[DrawnAgree]) -> AgreeLifts:
    """Return lifts of one control period, stacked; shorter ones continue at rest.

    Raises
    ------
    InputError
        If there are no lifts, or they have different control periods.
    """
    common_size([lift.scenario.frames_per_step for lift in drawn])
    longest = max(len(lift.target) for lift in drawn)
    people = [lift.scenario.subject for lift in drawn]

    def column(values: Sequence[float]) -> jax.Array:
        return jnp.asarray(values, jnp.float32)

    def obstacle(hurdles: Sequence[Hurdle | None]) -> Obstacle:
        rows = [(0.0,) * 4 if each is None else (*each, 1.0) for each in hurdles]
        return Obstacle(*map(column, zip(*rows, strict=True)))

    return AgreeLifts(
        target=joined([lift.target for lift in drawn], longest),
        times=joined([lift.times for lift in drawn], longest),
        shown=joined([lift.shown for lift in drawn], longest),
        gain=joined([lift.sensed.gain for lift in drawn], longest),
        tremor=joined([lift.sensed.tremor for lift in drawn], longest),
        noise=joined([lift.sensed.noise for lift in drawn], longest),
        sight=joined([lift.sight for lift in drawn], longest),
        uncertainty=column([lift.uncertainty for lift in drawn]),
        latency=jnp.asarray([lift.scenario.latency_frames for lift in drawn]),
        steps=jnp.asarray([len(lift.target) for lift in drawn]),
        human=obstacle([lift.human for lift in drawn]),
        robot=obstacle([lift.robot for lift in drawn]),
        agreeing=jnp.asarray([lift.agreeing for lift in drawn]).T,
        body=bodies_in_touch(people),
        manner=columns([agreeing_manner(person) for person in people]),
    )
