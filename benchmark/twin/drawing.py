"""The lifts of scenarios and seeds, drawn as the engine draws them, and stacked as arrays."""

from collections.abc import Sequence
from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.humans import Embodied, Subject
from colift.agents.humans.following import FOLLOWS_PLAN
from colift.agents.humans.hand import drawn_noise
from colift.agents.humans.person import Person
from colift.agents.rules import Drawn
from colift.base.errors import InputError
from colift.benchmark.episode.bodies import bodies_of
from colift.benchmark.episode.conditions import Drawn as DrawnConditions
from colift.benchmark.episode.lift import lasting
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.episode.sensing import drawn_errors
from colift.benchmark.tasks.ball.task import BALL
from colift.benchmark.tasks.level.task import Level
from colift.benchmark.tasks.robust.patient import SLOWS_DOWN, UNMOVED, Patience
from colift.benchmark.tasks.touch import Touch
from colift.benchmark.twin.arm import ArmVariation
from colift.benchmark.twin.body import Body, bodies
from colift.benchmark.twin.columns import LiftSeries, columns
from colift.benchmark.twin.lifts import Hand, Lifts, chunk
from colift.benchmark.world.table import TABLE_MASS
from numpy.typing import NDArray

Array = NDArray[Any]

MODELLED: Final = ("nao", "human")
"""Holders of the far end that the twin models; a second person on a level table alone."""


class DrawnLift(NamedTuple):
    """One lift of s steps of f frames, in NumPy."""

    scenario: Scenario
    conditions: DrawnConditions | None
    series: tuple[Any, Any, Any]
    """Target, the task's series and the person's, arrays (s * f,)."""
    numbers: tuple[Any, Any]
    """Those of the task and of the person."""
    noise: Array
    """(s, f, 2) gain and tremor of the hand."""
    errors: Array
    """(s, k) errors of the robot's senses."""
    ages: Array
    """(s,) age of the motion capture's sample in frames."""
    stop: int
    """Frame after the plan's last movement."""


def check_modelled(scenario: Scenario) -> None:
    """Check that the twin has all that a scenario needs.

    Raises
    ------
    InputError
        If the task, the holder of the far end or the behaviour is not modelled.
    """
    task = scenario.task
    level, touch = type(task) is Level, isinstance(task, Touch) and type(task).world is Touch.world
    if not level and not touch:
        raise InputError(
            f"the twin models the task level, and tasks that are stated by rules "
            f"({Touch.__name__}), in their own world; {task.name!r} is neither"
        )
    if isinstance(task, Touch) and task.rolling not in (None, BALL):
        raise InputError(f"the twin models the ball {BALL}, not {task.rolling}")
    known = MODELLED if level else MODELLED[:1]
    if scenario.partner not in known:
        names = " or ".join(map(repr, known))
        raise InputError(f"the twin of {task.name!r} models {names}, not {scenario.partner!r}")
    if isinstance(scenario.human, Embodied):
        raise InputError(
            f"the twin models scripted people only; {scenario.behaviour!r} brings its own"
        )


def common_rules(scenarios: Sequence[Scenario]) -> Person:
    """Return the rules of the people in some scenarios.

    Those who go along with their plan are people who slow down, of endless patience.

    Raises
    ------
    InputError
        If they have different rules.
    """
    found = list(dict.fromkeys(each.rules for each in scenarios))
    if {*found} == {FOLLOWS_PLAN, SLOWS_DOWN}:
        return SLOWS_DOWN
    if len(found) != 1:
        raise InputError(f"the twin needs people of the same rules, got {len(found)} kinds")
    return found[0]


def draw_lift(
    scenario: Scenario, seed: int, rules: Person | None = None, longest: float | None = None
) -> DrawnLift:
    """Return the drawn arrays of a lift, the same as :class:`.Lift` plays.

    Parameters
    ----------
    scenario, seed
        The lift.
    rules
        The rules of its person; None are the scenario's. See :func:`common_rules`.
    longest
        Time after which it is cut off [s]; None leaves it whole.

    Raises
    ------
    InputError
        As :func:`check_modelled`.
    """
    check_modelled(scenario)
    task, person, size = scenario.task, scenario.subject, scenario.frames_per_step

    def role_seed(role: str) -> int:
        return derive_seed(seed, f"{role}/{scenario.name}")

    plan = scenario.human.plan(person, role_seed("plan"))
    steps = -(-len(plan.target) // size)
    kept = steps if longest is None else min(steps, round(longest / scenario.control_period))
    series, facts = task.setting(plan, steps * size, role_seed)
    chance, manner = scenario.rules.draw(person, role_seed, steps, size)
    if rules is SLOWS_DOWN and scenario.rules is FOLLOWS_PLAN:
        manner = Patience(UNMOVED)
    conditions = scenario.conditions
    drawn = None if conditions is None else conditions.draw(role_seed, steps, size)
    ages, precision = np.full(steps + 1, scenario.latency_frames), 1.0
    if drawn:
        ages, precision = drawn.ages, drawn.noise
    noise = drawn_noise(person, role_seed("human"), steps * size).T.reshape(steps, size, 2)
    errors = drawn_errors(task.senses, task.touch, role_seed, steps, size, ages, precision)
    whole = (lasting(plan.target, steps * size), series, chance)
    return DrawnLift(
        scenario,
        drawn,
        jax.tree.map(lambda each: each[: kept * size], whole),
        (facts, manner),
        noise[:kept],
        errors[:kept],
        ages[:kept],
        min(plan.strokes[-1][1] if plan.strokes else 0, kept * size),
    )


def stack(drawn: Sequence[DrawnLift]) -> Lifts:
    """Return lifts of one task and one control period, stacked; shorter ones continue at rest.

    Raises
    ------
    InputError
        If there is no lift, or there are different control periods.
    """
    sizes = {lift.scenario.frames_per_step for lift in drawn}
    if len(sizes) != 1:
        raise InputError(f"the twin needs lifts of one control period, got {len(sizes)}")
    (size,) = sizes
    if size % chunk(size):
        raise InputError(f"the twin cannot divide a step of {size} frames")
    steps = [len(lift.errors) for lift in drawn]
    longest = max(steps)
    target, series, chance = (
        jax.tree.map(lambda *arrays: LiftSeries.of(_joined(arrays, longest * size)), *each)
        for each in zip(*(lift.series for lift in drawn), strict=True)
    )
    facts, manner = (columns(each) for each in zip(*(lift.numbers for lift in drawn), strict=True))
    noise = _joined([lift.noise for lift in drawn], longest)
    found = [bodies_of(lift.scenario, lift.conditions) for lift in drawn]
    body = bodies(
        [each.human for each in found],
        drawn[0].scenario.task.physics.step,
        [each.table.mass / TABLE_MASS for each in found],
    )
    return Lifts(
        drawn=Drawn(target, series, facts, chance, manner),
        gain=noise[:, :, 0],
        tremor=noise[:, :, 1],
        hand=columns([_hand(lift.scenario.subject) for lift in drawn]),
        errors=_joined([lift.errors for lift in drawn], longest),
        ages=_joined([lift.ages for lift in drawn], longest),
        stop=jnp.asarray([lift.stop for lift in drawn], float),
        steps=jnp.asarray(steps),
        body=body,
        arms=_arms([lift.conditions for lift in drawn], body),
    )


def draw_lifts(lifts: Sequence[tuple[Scenario, int]]) -> Lifts:
    """Return the lifts of scenarios and seeds, the same as :class:`.Lift` plays.

    Raises
    ------
    InputError
        If there are no lifts, they have different control periods or rules, or one is not modelled.
    """
    rules = common_rules([scenario for scenario, _ in lifts]) if lifts else None
    return stack([draw_lift(scenario, seed, rules) for scenario, seed in lifts])


def _hand(person: Subject) -> Hand:
    """Return how unsteady a person's hand is."""
    return Hand(person.motor_noise, person.tremor_amplitude, person.tremor_frequency)


def _arms(conditions: Sequence[DrawnConditions | None], body: Body) -> ArmVariation | None:
    """Return the variation of the robots' arms, if any lift has conditions."""
    if not any(conditions):
        return None
    factors = [(each.sag, each.gain) if each else (1.0, 1.0) for each in conditions]
    sag, gain = jnp.asarray(factors, float).T
    return ArmVariation(sag, gain, body.load)


def _joined(arrays: Sequence[Array], many: int) -> jax.Array:
    """Return arrays as one (many, ..., n); shorter ones repeat their end."""
    kind = arrays[0].dtype if arrays[0].dtype.kind == "i" else jnp.result_type(float)
    filled = np.empty((many, *arrays[0].shape[1:], len(arrays)), kind)
    for index, array in enumerate(arrays):
        filled[: len(array), ..., index] = array
        filled[len(array) :, ..., index] = array[-1]
    return jnp.asarray(filled)
