"""Drawn lifts of a level table with conditions, and people who may slow down, as arrays."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.humans.following import FOLLOWS_PLAN
from colift.agents.humans.hand import drawn_noise
from colift.agents.rules import Drawn
from colift.base.errors import InputError
from colift.benchmark.episode.bodies import bodies_of
from colift.benchmark.episode.conditions import Conditions
from colift.benchmark.episode.conditions import Drawn as DrawnConditions
from colift.benchmark.episode.lift import lasting
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.episode.sensing import drawn_errors
from colift.benchmark.tasks.level.task import Level
from colift.benchmark.tasks.robust.patient import SLOWS_DOWN, UNMOVED, Patience
from colift.benchmark.twin.arm import ArmVariation
from colift.benchmark.twin.body import Body, bodies
from colift.benchmark.twin.columns import LiftSeries, columns
from colift.benchmark.twin.lifts import check_scripted
from colift.benchmark.world.table import TABLE_MASS
from numpy.typing import NDArray

Array = NDArray[np.float64]


class ConditionedLifts(NamedTuple):
    """n lifts of at most s steps of f frames, in single precision."""

    drawn: Drawn[Any]
    """Plans, and the people's patience."""
    gain: jax.Array
    """(s, f, n) signal-dependent noise of the person's hand, relative to its velocity."""
    tremor: jax.Array
    """(s, f, n) tremor of the hand [m]."""
    errors: jax.Array
    """(s, 2, n) error of the motion capture at either end in the sample of each step [m]."""
    ages: jax.Array
    """(s, n) age of that sample in frames."""
    stop: jax.Array
    """(n,) frame after the plan's last movement."""
    steps: jax.Array
    """(n,) length in steps."""
    body: Body
    """The people, and their tables."""
    arms: ArmVariation
    """The robots' arms."""

    @property
    def size(self) -> int:
        """Number of lifts."""
        return int(self.steps.shape[0])

    @property
    def frames(self) -> int:
        """Frames of a step."""
        return int(self.gain.shape[1])


class DrawnConditioned(NamedTuple):
    """One lift in NumPy."""

    scenario: Scenario
    conditions: DrawnConditions
    target: Array
    """(s * f,)"""
    noise: Array
    """(s, f, 2) gain and tremor."""
    errors: Array
    """(s, 2)"""
    patience: float
    stop: int


def check_conditioned(scenario: Scenario) -> None:
    """Check that the twin with conditions has all that a scenario needs.

    Raises
    ------
    InputError
        If the task, the holder of the far end or the people are not modelled.
    """
    if type(scenario.task) is not Level:
        raise InputError(f"conditions are modelled for the task level, not {scenario.task.name!r}")
    if scenario.partner != "nao":
        raise InputError(f"conditions are modelled for a NAO, not for {scenario.partner!r}")
    check_scripted(scenario)
    if scenario.rules not in (FOLLOWS_PLAN, SLOWS_DOWN):
        raise InputError(
            f"the twin models people who go along with their plan, and who slow down; those of "
            f"{scenario.behaviour!r} have other rules"
        )


def draw_conditioned(
    scenario: Scenario, seed: int, longest: float | None = None
) -> DrawnConditioned:
    """Return the drawn arrays of a lift, the same as :class:`.Lift` plays.

    Parameters
    ----------
    scenario, seed
        The lift; without conditions, it has the benchmark's.
    longest
        Time after which it is cut off [s]; None leaves it whole.

    Raises
    ------
    InputError
        As :func:`check_conditioned`.
    """
    check_conditioned(scenario)
    person, size = scenario.subject, scenario.frames_per_step

    def role_seed(role: str) -> int:
        return derive_seed(seed, f"{role}/{scenario.name}")

    plan = scenario.human.plan(person, role_seed("plan"))
    steps = -(-len(plan.target) // size)
    given = scenario.conditions or Conditions(latency=(scenario.latency, scenario.latency))
    drawn = given.draw(role_seed, steps, size)
    errors = drawn_errors((), False, role_seed, steps, size, drawn.ages, drawn.noise)
    noise = drawn_noise(person, role_seed("human"), steps * size)
    _, manner = scenario.rules.draw(person, role_seed, steps, size)
    slows = scenario.rules is SLOWS_DOWN
    kept = steps if longest is None else min(steps, round(longest / scenario.control_period))
    return DrawnConditioned(
        scenario,
        drawn._replace(ages=drawn.ages[:kept]),
        lasting(plan.target, steps * size)[: kept * size],
        noise.T.reshape(steps, size, 2)[:kept],
        errors[:kept, :2],
        manner.patience if slows else UNMOVED,
        min(plan.strokes[-1][1] if plan.strokes else 0, kept * size) if slows else 0,
    )


def stack_conditioned(drawn: Sequence[DrawnConditioned]) -> ConditionedLifts:
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
    noise = _joined([lift.noise for lift in drawn], longest)
    conditions = [lift.conditions for lift in drawn]
    loads = [each.table.mass / TABLE_MASS for each in conditions]
    people = [bodies_of(lift.scenario, lift.conditions).human for lift in drawn]
    body = bodies(people, loads=loads)
    return ConditionedLifts(
        drawn=Drawn(
            LiftSeries.of(_joined([lift.target for lift in drawn], longest * size)),
            (),
            (),
            (),
            columns([Patience(lift.patience) for lift in drawn]),
        ),
        gain=noise[:, :, 0],
        tremor=noise[:, :, 1],
        errors=_joined([lift.errors for lift in drawn], longest),
        ages=_joined([each.ages for each in conditions], longest),
        stop=jnp.asarray([lift.stop for lift in drawn], float),
        steps=jnp.asarray(steps),
        body=body,
        arms=ArmVariation(
            jnp.asarray([each.sag for each in conditions], float),
            jnp.asarray([each.gain for each in conditions], float),
            body.load,
        ),
    )


def _joined(arrays: Sequence[NDArray[Any]], many: int) -> jax.Array:
    """Return arrays as one (many, ..., n); shorter ones repeat their end."""
    kind = arrays[0].dtype if arrays[0].dtype.kind == "i" else jnp.result_type(float)
    filled = np.empty((many, *arrays[0].shape[1:], len(arrays)), kind)
    for index, array in enumerate(arrays):
        filled[: len(array), ..., index] = array
        filled[len(array) :, ..., index] = array[-1]
    return jnp.asarray(filled)
