"""Comparison of a task's rules: for one lift in the engine, and for arrays in the twin."""

import contextlib
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from importlib import import_module
from typing import Any, Final, NamedTuple, cast

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.agent import Agent
from colift.agents.humans.person import Person
from colift.agents.rules import SCALARS, Drawn
from colift.benchmark.episode.lift import READ, Lift
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.turns import policy_seed
from colift.benchmark.tasks.level.task import Level
from colift.benchmark.tasks.touch import Ends, Touch, frame_of
from colift.benchmark.twin.columns import LiftSeries, columns
from colift.benchmark.twin.drawing import check_modelled
from colift.benchmark.twin.functions import LIFTS
from colift.benchmark.twin.view import aged
from colift.benchmark.world.interface import HISTORY_FRAMES

CLOSE: Final = 1e-9
"""Largest difference of a number, in its unit, that rounding explains in double precision."""


class Past(NamedTuple):
    """A lift of the engine as arrays of one lift."""

    frame: jax.Array
    visual: jax.Array
    haptic: jax.Array
    latency: jax.Array
    hand: jax.Array
    command: jax.Array
    read: Mapping[str, jax.Array]
    """(HISTORY_FRAMES, 1) each read-out, newest first."""

    def seen(self, name: str, age: Any) -> jax.Array:
        """Return a past read-out; see :meth:`.View.seen`."""
        return aged(self.read[name], age)


def past_of(lift: Lift) -> Past:
    """Return the read-outs of a lift now."""

    def one(number: float) -> jax.Array:
        return jnp.asarray([number])

    names = (*READ, *lift.task.person.intention._fields)
    read = {
        name: jnp.asarray([[lift.seen(name, age)] for age in range(HISTORY_FRAMES)], float)
        for name in names
    }
    return Past(
        frame=jnp.asarray(lift.frame),
        visual=one(lift.visual),
        haptic=one(lift.haptic),
        latency=one(lift.latency),
        hand=one(lift.hand),
        command=one(lift.command),
        read=read,
    )


def drawn_arrays(lift: Lift) -> Drawn[Any]:
    """Return what is drawn of a lift that was reset, as arrays of one lift."""
    plan, size = lift.drawn, lift.frames_per_step
    chance, manner = lift.scenario.rules.draw(
        lift.scenario.subject, lift.role_seed, lift.horizon // size, size
    )

    def series(arrays: Any) -> Any:
        return jax.tree.map(lambda array: LiftSeries.of(jnp.asarray(array)[:, None]), arrays)

    return Drawn(
        series(lift.target), series(lift.due), columns([plan.facts]), series(chance),
        columns([manner]),
    )  # fmt: skip


def double_precision() -> AbstractContextManager[Any]:
    """Return a context in which JAX computes in double precision, in old and new versions."""
    if hasattr(jax, "enable_x64"):
        return cast(AbstractContextManager[Any], jax.enable_x64(True))
    before: Any = import_module("jax.experimental")
    return cast(AbstractContextManager[Any], before.enable_x64())


class Rules(NamedTuple):
    """The rules of a task and its person as functions of arrays, with the same of numbers."""

    task: Level
    person: Person
    drawn: Drawn[Any]
    frames: int

    def begin(self) -> Any:
        """Return the person's memory at the beginning."""
        return self.person.begin(LIFTS, jnp.zeros(1), jnp.zeros(1, bool))

    def decide(self, memory: Any, past: Past) -> tuple[Any, Any, Any]:
        """Return the person's memory after a step and the intention, and what the robot senses."""
        after, intention = self.person.intend(LIFTS, self.drawn, memory, past, self.frames)
        return after, intention, self.task.observe(LIFTS, self.drawn, past)

    def drive(self, intention: Any, references: jax.Array) -> Any:
        """Return the driven differences and pitches."""
        driven = self.person.drive(LIFTS, self.drawn, intention, references)
        return tuple(jnp.broadcast_to(each, references.shape) for each in driven)

    def judge(self, frame: jax.Array, ends: Ends) -> tuple[Any, Any]:
        """Return the squares that are missed in a frame, and whether it is lost, with touch."""
        assert isinstance(self.task, Touch)
        due = jax.tree.map(
            lambda each: each.at(frame),
            self.drawn.series,
            is_leaf=lambda each: isinstance(each, LiftSeries),
        )
        return self.task.missed(LIFTS, due, ends), self.task.lost(LIFTS, ends)

    def left(self, past: Past) -> Any:
        """Return how many frames of the plan are unfinished, with touch."""
        assert isinstance(self.task, Touch)
        return self.task.unfinished(LIFTS, self.drawn, past)


def largest_difference(scenario: Scenario, seed: int, make: Callable[[], Agent]) -> float:
    """Return the largest difference of a rule's results, as numbers and as arrays, in a lift.

    The lift is played in the engine. In each step the rules of task and person get the same
    read-outs as arrays in double precision, with a memory of their own. They are traced, so that an
    ``if`` on a number of the lift is an error of JAX in the line of the rule.

    Parameters
    ----------
    scenario, seed
        The lift.
    make
        Returns the robot.

    Raises
    ------
    InputError
        If the twin does not model the scenario.
    """
    check_modelled(scenario)
    robot, worst = make(), [0.0]
    robot.reset(policy_seed())

    def compare(one: Any, other: Any) -> None:
        difference = np.ravel(np.asarray(one, float)) - np.ravel(np.asarray(other, float))
        worst.append(float(np.abs(difference).max(initial=0.0)))

    with contextlib.closing(Lift(scenario)) as lift, double_precision():
        lift.reset(seed)
        task, person = lift.task, scenario.rules
        assert isinstance(task, Level)
        human, size = lift.human(), lift.frames_per_step
        rules = Rules(task, person, drawn_arrays(lift), size)
        decide, drive, judge = jax.jit(rules.decide), jax.jit(rules.drive), jax.jit(rules.judge)
        left = jax.jit(rules.left)
        memory = rules.begin()
        while not lift.done:
            memory, intention, sensed = decide(memory, past_of(lift))
            compare(lift.intention, intention)
            compare(task.observe(SCALARS, lift.drawn, lift), sensed)
            references, first = human.references(), lift.frame
            driven = [
                person.drive(SCALARS, lift.drawn, type(intention)(*each), reference)
                for *each, reference in zip(*lift.intention, references, strict=True)
            ]
            arrays = drive(intention, jnp.asarray(references)[:, np.newaxis])
            compare(list(zip(*driven, strict=True)), arrays)
            lift.step(references, robot.act(lift.partner_observation()))
            if not isinstance(task, Touch):
                continue
            world, last = lift.world, first + size - 1
            ends = Ends(world.human_end[-1], world.robot_end[-1], world.ball_place[-1])
            missed, lost = judge(jnp.asarray(last), Ends(*(jnp.asarray([x]) for x in ends)))
            compare(task.missed(SCALARS, frame_of(lift.due, last), ends), missed)
            compare(task.lost(SCALARS, ends), lost)
            compare(task.unfinished(SCALARS, lift.drawn, lift), left(past_of(lift)))
    return max(worst)
