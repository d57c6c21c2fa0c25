"""Drawn lifts of tasks with touch, as arrays: those that the engine plays."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.humans.hand import drawn_noise
from colift.agents.rules import Drawn
from colift.base.errors import InputError
from colift.benchmark.episode.lift import lasting
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seat import body_parameters
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.episode.sensing import drawn_errors
from colift.benchmark.tasks.ball.task import BALL
from colift.benchmark.tasks.touch import FINER, Touch
from colift.benchmark.twin.body import Body, bodies
from colift.benchmark.twin.columns import LiftSeries, columns
from colift.benchmark.twin.lifts import check_people
from numpy.typing import NDArray

Array = NDArray[np.float64]


class TouchLifts(NamedTuple):
    """n lifts of at most s steps of f frames, in single precision."""

    drawn: Drawn[Any]
    """Plans, and what else is drawn of tasks and people."""
    gain: jax.Array
    """(s, f, n) signal-dependent noise of the person's hand, relative to its velocity."""
    tremor: jax.Array
    """(s, f, n) tremor of the hand [m]."""
    errors: jax.Array
    """(s, k, n) errors of the robot's senses."""
    latency: jax.Array
    """(n,) age of the motion capture's sample in frames."""
    steps: jax.Array
    """(n,) length in steps."""
    body: Body
    """The people."""

    @property
    def size(self) -> int:
        """Number of lifts."""
        return int(self.steps.shape[0])

    @property
    def frames(self) -> int:
        """Frames of a step."""
        return int(self.gain.shape[1])


class DrawnTouch(NamedTuple):
    """One lift in NumPy."""

    scenario: Scenario
    series: tuple[Any, Any, Any]
    """Target, the task's series and the person's, arrays (s * f,)."""
    numbers: tuple[Any, Any]
    """Those of the task and of the person."""
    noise: Array
    """(s, f, 2) gain and tremor."""
    errors: Array
    """(s, k)"""


def check_twin(scenario: Scenario) -> None:
    """Check that the twin of tasks with touch has all that a scenario needs.

    Raises
    ------
    InputError
        If the task, the holder of the far end, the behaviour or the latency is not modelled.
    """
    task = scenario.task
    if not isinstance(task, Touch) or type(task).world is not Touch.world:
        raise InputError(
            f"the twin models tasks that are stated by rules ({Touch.__name__}), in their own "
            f"world; {task.name!r} is not"
        )
    if task.rolling not in (None, BALL):
        raise InputError(f"the twin models the ball {BALL}, not {task.rolling}")
    if scenario.partner != "nao":
        raise InputError(f"the twin of {task.name!r} models a NAO, not {scenario.partner!r}")
    check_people(scenario)


def draw_touch(scenario: Scenario, seed: int) -> DrawnTouch:
    """Return the drawn arrays of a lift, the same as :class:`.Lift` plays.

    Raises
    ------
    InputError
        As :func:`check_twin`.
    """
    check_twin(scenario)
    task, person, size = scenario.task, scenario.subject, scenario.frames_per_step

    def role_seed(role: str) -> int:
        return derive_seed(seed, f"{role}/{scenario.name}")

    plan = scenario.human.plan(person, role_seed("plan"))
    steps = -(-len(plan.target) // size)
    series, facts = task.setting(plan, steps * size, role_seed)
    chance, manner = task.person.draw(person, role_seed, steps, size)
    errors = drawn_errors(task.senses, task.touch, role_seed, steps, size, scenario.latency_frames)
    noise = drawn_noise(person, role_seed("human"), steps * size)
    return DrawnTouch(
        scenario,
        (lasting(plan.target, steps * size), series, chance),
        (facts, manner),
        noise.T.reshape(steps, size, 2),
        errors[:-1],
    )


def stack_touch(drawn: Sequence[DrawnTouch]) -> TouchLifts:
    """Return lifts of one control period, stacked; shorter ones continue at rest.

    Raises
    ------
    InputError
        If there is no lift, or there are different control periods.
    """
    sizes = {lift.scenario.frames_per_step for lift in drawn}
    if len(sizes) != 1:
        raise InputError(f"the twin needs lifts of one control period, got {len(sizes)}")
    (size,) = sizes
    steps = [len(lift.errors) for lift in drawn]
    longest = max(steps)
    target, series, chance = (
        jax.tree.map(lambda *arrays: LiftSeries.of(_joined(arrays, longest * size)), *each)
        for each in zip(*(lift.series for lift in drawn), strict=True)
    )
    facts, manner = (columns(each) for each in zip(*(lift.numbers for lift in drawn), strict=True))
    noise = _joined([lift.noise for lift in drawn], longest)
    people = [body_parameters(lift.scenario.subject) for lift in drawn]
    return TouchLifts(
        drawn=Drawn(target, series, facts, chance, manner),
        gain=noise[:, :, 0],
        tremor=noise[:, :, 1],
        errors=_joined([lift.errors for lift in drawn], longest),
        latency=jnp.asarray([lift.scenario.latency_frames for lift in drawn]),
        steps=jnp.asarray(steps),
        body=bodies(people, FINER.step),
    )


def _joined(arrays: Sequence[Array], many: int) -> jax.Array:
    """Return arrays as one (many, ..., n); shorter ones repeat their end."""
    filled = np.empty((many, *arrays[0].shape[1:], len(arrays)), jnp.result_type(float))
    for index, array in enumerate(arrays):
        filled[: len(array), ..., index] = array
        filled[len(array) :, ..., index] = array[-1]
    return jnp.asarray(filled)
