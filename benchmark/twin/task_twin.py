"""The twin of a task with touch, from its rules and those of its people."""

from dataclasses import dataclass
from typing import Any, NamedTuple, cast

import jax
import jax.numpy as jnp
from colift.agents.actions import action_limit
from colift.agents.agent import FRAME
from colift.agents.humans.hand import HandMemory, HandNoise, carry_out
from colift.benchmark.episode.metrics import FAILED_FRAME_MM
from colift.benchmark.episode.seat import REFERENCE_RANGE, limited_command
from colift.benchmark.episode.sensing import sight, touch
from colift.benchmark.tasks.touch import Ends, Touch, gathered
from colift.benchmark.twin.arm import ArmVariation
from colift.benchmark.twin.ball_plant import BallPlant, advance_ball_plant, ball_plant_at_rest
from colift.benchmark.twin.body import DEPTH, Body, pushed
from colift.benchmark.twin.functions import LIFTS
from colift.benchmark.twin.haptic_plant import (
    HapticPlant,
    Meant,
    advance_haptic_plant,
    haptic_plant_at_rest,
)
from colift.benchmark.twin.learning_person import (
    Added,
    LearningPerson,
    added_in_step,
    person_senses,
)
from colift.benchmark.twin.lifts import chunk
from colift.benchmark.twin.playing import ramp
from colift.benchmark.twin.rollout import Policy
from colift.benchmark.twin.touch_lifts import TouchLifts
from colift.benchmark.twin.touch_view import TouchState, TouchView
from colift.robots.nao.kinematics import STROKE


class Noise(NamedTuple):
    """A step's share of :class:`.TouchLifts`, see there."""

    gain: jax.Array
    tremor: jax.Array
    errors: jax.Array


class Missed(NamedTuple):
    """The contributions of a step to the error of n lifts."""

    squares: tuple[jax.Array, ...]
    """Squares [m2] for each number of :attr:`.Touch.stays`: their sum (n,), or, where a place has
    to be held, those of all frames (f, n)."""
    unfinished: jax.Array
    """(n,) the frames of the plan that are not done, in the last step of a lift; 0 before."""


@dataclass(frozen=True)
class TaskTwin:
    """The lifts of a task, step by step, as pure functions of n lifts."""

    task: Touch

    def at_rest(self, count: int) -> TouchState:
        """Return lifts before the first step."""
        zero, past = jnp.zeros(count), jnp.zeros((DEPTH, count))
        person = self.task.person
        table = haptic_plant_at_rest if self.task.rolling is None else ball_plant_at_rest
        return TouchState(
            table=table(count),
            command=zero,
            hand=HandMemory(zero, zero, zero),
            memory=person.begin(LIFTS, zero, jnp.zeros(count, bool)),
            intentions=person.intention(*[past] * len(person.intention._fields)),
            lost=zero,
            step=jnp.zeros((), jnp.int32),
        )

    def noise(self, lifts: TouchLifts) -> Noise:
        """Return the shares of all steps, with a first axis of steps."""
        return Noise(lifts.gain, lifts.tremor, lifts.errors)

    def observe(self, state: TouchState, lifts: TouchLifts, noise: Noise) -> jax.Array:
        """Return the robot's observations (k, n)."""
        view = TouchView(state, lifts)
        own = self.task.observe(LIFTS, lifts.drawn, view)
        exact = LIFTS.row([*sight(LIFTS, view), *touch(LIFTS, view), *own], state.command)
        return exact + noise.errors

    def known(self, state: TouchState, lifts: TouchLifts) -> jax.Array:
        """Return what n people know about the task (k, n); see :meth:`.Person.knows`."""
        view, person = TouchView(state, lifts), self.task.person
        return LIFTS.row(
            person.knows(LIFTS, lifts.drawn, state.memory, view, lifts.frames), state.command
        )

    def step(
        self,
        state: TouchState,
        lifts: TouchLifts,
        noise: Noise,
        action: jax.Array,
        variation: ArmVariation | None = None,
        added: Added | None = None,
    ) -> tuple[TouchState, Ends]:
        """Return the lifts after a step, and the read-outs in its frames (f, n).

        Parameters
        ----------
        state, lifts
            The lifts.
        noise
            The step's share of their noise.
        action
            (n,) change of the command [m], clipped to the hands' speed and stroke.
        variation
            Variation of the arms; None is the benchmark's arms.
        added
            Additions by learning people; None adds nothing.
        """
        view, person, size = TouchView(state, lifts), self.task.person, lifts.frames
        memory, intention = person.intend(LIFTS, lifts.drawn, state.memory, view, size)
        hand, found = carry_out(
            LIFTS, state.hand, view, intention.target, HandNoise(noise.gain, noise.tremor)
        )
        references = cast(jax.Array, found)
        driven = person.drive(LIFTS, lifts.drawn, intention, references)
        differences, wrist = (jnp.broadcast_to(each, references.shape) for each in driven)
        if added is not None:
            references, wrist = references + added.height, wrist + added.pitch
        meant = Meant(jnp.clip(references, *REFERENCE_RANGE), differences, wrist)
        after = limited_command(LIFTS, state.command, action, action_limit(size * FRAME), STROKE)
        commands = ramp(state.command, after, size)
        table, ends = moved_table(state.table, lifts.body, meant, commands, variation)
        lost = jnp.broadcast_to(self.task.lost(LIFTS, ends), references.shape).any(axis=0)
        return TouchState(
            table=table,
            command=commands[-1],
            hand=hand,
            memory=memory,
            intentions=jax.tree.map(pushed, state.intentions, intention),
            lost=jnp.maximum(state.lost, lost.astype(state.lost.dtype)),
            step=state.step + 1,
        ), ends

    def missed(self, state: TouchState, after: TouchState, lifts: TouchLifts, ends: Ends) -> Missed:
        """Return the contributions of a step to the error, from the states before and after it.

        After a lift is lost, each frame of the steps that follow counts with
        :data:`.FAILED_FRAME_MM`, as in the engine, so that the loss is finite. Its gradient comes
        only from the frames until then.
        """
        frame, size = state.step * lifts.frames, lifts.frames
        due = jax.tree.map(
            lambda series: series.next(frame, size),
            lifts.drawn.series,
            is_leaf=lambda each: hasattr(each, "next"),
        )
        cut = size * (FAILED_FRAME_MM / 1000) ** 2
        lasts = state.step < lifts.steps
        squares = tuple(
            each if stay else jnp.where(state.lost > 0, cut, each.sum(axis=0)) * lasts
            for each, stay in zip(self.task.missed(LIFTS, due, ends), self.task.stays, strict=True)
        )
        left = self.task.unfinished(LIFTS, lifts.drawn, TouchView(after, lifts))
        return Missed(squares, jnp.where(after.step == lifts.steps, left, 0.0))

    def score_mm(self, lifts: TouchLifts, missed: Missed) -> jax.Array:
        """Return the scores (n,) [mm] from the contributions of all steps, stacked.

        The rule is that of :meth:`.Touch.rmse_mm`.
        """
        squares = [
            gathered(each.reshape(-1, lifts.size), stay)
            for each, stay in zip(missed.squares, self.task.stays, strict=True)
        ]
        frames, missing = lifts.steps * lifts.frames, missed.unfinished.sum(axis=0)
        error = frames * self.task.error(LIFTS, lifts.drawn.facts, squares, frames)
        cut = missing * (FAILED_FRAME_MM / 1000) ** 2
        return 1000 * jnp.sqrt((error + cut) / (frames + missing) + 1e-12)

    def rmse_mm(
        self,
        policy: Policy,
        memory: Any,
        lifts: TouchLifts,
        variation: ArmVariation | None = None,
        person: LearningPerson | None = None,
    ) -> jax.Array:
        """Return the scores (n,) [mm] of lifts with a policy; differentiable.

        Drops of the table are not modelled.

        Parameters
        ----------
        policy, memory
            The policy, and its memory at the beginning.
        lifts
            People, plans and noise.
        variation
            Variation of the arms; None is the benchmark's arms.
        person
            A person who has learned; None is the benchmark's.
        """

        def step(held: tuple[Any, Any, Any], noise: Noise) -> tuple[tuple[Any, Any, Any], Any]:
            state, memory, minding = held
            added = None
            if person is not None:
                mind, before = minding
                view = (person_senses(state.haptic.plant, lifts.body), self.known(state, lifts))
                mind, after = person.policy(mind, jnp.concatenate(view))
                minding, added = (mind, after), added_in_step(before, after, lifts.frames)
            memory, action = policy(memory, self.observe(state, lifts, noise))
            later, ends = self.step(state, lifts, noise, action, variation, added)
            return (later, memory, minding), self.missed(state, later, lifts, ends)

        minding = None if person is None else (person.memory, jnp.zeros((2, lifts.size)))
        begun = (self.at_rest(lifts.size), memory, minding)
        _, missed = jax.lax.scan(jax.checkpoint(step), begun, self.noise(lifts))
        return self.score_mm(lifts, missed)


def moved_table(
    table: BallPlant | HapticPlant,
    body: Body,
    meant: Meant,
    commands: jax.Array,
    variation: ArmVariation | None,
) -> tuple[BallPlant | HapticPlant, Ends]:
    """Return the table after a step, and its read-outs in each frame (f, n)."""
    size, parts = len(commands), []
    many = chunk(size)
    for first in range(0, size, many):
        frames = slice(first, first + many)
        some = Meant(*(each[frames] for each in meant))
        if isinstance(table, BallPlant):
            table = advance_ball_plant(table, body, some, commands[frames], variation)
            plant, ball = table.haptic.plant, table.places[:many][::-1]
        else:
            table, _, _ = advance_haptic_plant(table, body, some, commands[frames], variation)
            plant, ball = table.plant, jnp.zeros_like(commands[frames])
        near = plant.heights[:many][::-1]
        parts.append(Ends(near, near + plant.differences[:many][::-1], ball))
    return table, Ends(*map(jnp.concatenate, zip(*parts, strict=True)))
