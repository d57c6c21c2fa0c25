"""The twin of a task, from its rules and those of its people."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Self, cast

import jax
import jax.numpy as jnp
from colift.agents.actions import action_limit
from colift.agents.agent import FRAME
from colift.agents.humans.hand import HandMemory, HandNoise, carry_out
from colift.agents.humans.person import Person
from colift.benchmark.episode.drops import pulled_off, slides_off
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seat import REFERENCE_RANGE, limited_command
from colift.benchmark.episode.sensing import sight, touch
from colift.benchmark.tasks.level.task import Level
from colift.benchmark.tasks.running_score import WORST, square_at_end
from colift.benchmark.tasks.touch import Ends, Touch, gathered
from colift.benchmark.twin.ball_plant import BallPlant, ball_plant_at_rest
from colift.benchmark.twin.body import DEPTH, pushed
from colift.benchmark.twin.commands import ramp
from colift.benchmark.twin.drawing import common_rules
from colift.benchmark.twin.functions import LIFTS
from colift.benchmark.twin.haptic_plant import HapticPlant, Meant, haptic_plant_at_rest
from colift.benchmark.twin.learning_person import Added
from colift.benchmark.twin.lifts import Lifts, Share
from colift.benchmark.twin.moving import moved_table
from colift.benchmark.twin.plant import Plant, plant_at_rest
from colift.benchmark.twin.view import LiftState, LiftView
from colift.benchmark.world.interface import HISTORY_FRAMES
from colift.robots.nao.kinematics import STROKE


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

    task: Level
    person: Person
    """The rules of the people."""
    depth: int = DEPTH
    """Frames of past heights that are kept: samples are younger."""

    @classmethod
    def of(cls, scenarios: Sequence[Scenario]) -> Self:
        """Return the twin of scenarios of one task.

        Raises
        ------
        InputError
            If their people have different rules.
        """
        late = any(each.conditions or each.latency_frames >= DEPTH for each in scenarios)
        depth = HISTORY_FRAMES if late else DEPTH
        task = scenarios[0].task
        assert isinstance(task, Level), task
        return cls(task, common_rules(scenarios), depth)

    @property
    def stays(self) -> tuple[int, ...]:
        """How the squares of frames are gathered; see :attr:`.Touch.stays`."""
        return self.task.stays if isinstance(self.task, Touch) else (0,)

    def at_rest(self, lifts: Lifts) -> LiftState:
        """Return lifts before the first step."""
        count = lifts.size
        zero, past = jnp.zeros(count), jnp.zeros((DEPTH, count))
        return LiftState(
            table=self._table(count, lifts.body.load),
            command=zero,
            hand=HandMemory(zero, zero, zero),
            memory=self.person.begin(LIFTS, zero, jnp.zeros(count, bool)),
            intentions=self.person.intention(*[past] * len(self.person.intention._fields)),
            lost=zero,
            step=jnp.zeros((), jnp.int32),
        )

    def _table(self, count: int, load: jax.Array) -> Plant | HapticPlant | BallPlant:
        if not isinstance(self.task, Touch):
            return plant_at_rest(count, load, self.depth)
        return (haptic_plant_at_rest if self.task.rolling is None else ball_plant_at_rest)(count)

    def observe(self, state: LiftState, lifts: Lifts, share: Share) -> jax.Array:
        """Return the robot's observations (k, n)."""
        view = LiftView(state, lifts, share.ages)
        felt = touch(LIFTS, view) if self.task.touch else ()
        own = self.task.observe(LIFTS, lifts.drawn, view)
        return LIFTS.row([*sight(LIFTS, view), *felt, *own], state.command) + share.errors

    def known(self, state: LiftState, lifts: Lifts, share: Share) -> jax.Array:
        """Return what n people know about the task (k, n); see :meth:`.Person.knows`."""
        view = LiftView(state, lifts, share.ages)
        known = self.person.knows(LIFTS, lifts.drawn, state.memory, view, lifts.frames)
        return LIFTS.row(known, state.command)

    def step(
        self,
        state: LiftState,
        lifts: Lifts,
        share: Share,
        action: jax.Array,
        added: Added | None = None,
    ) -> tuple[LiftState, Ends]:
        """Return the lifts after a step, and the read-outs in its frames (f, n).

        Parameters
        ----------
        state, lifts
            The lifts.
        share
            The step's share of their noise.
        action
            (n,) change of the command [m], clipped to the hands' speed and stroke.
        added
            Additions by learning people; None adds nothing.
        """
        size = lifts.frames
        memory, intention, hand, references = self.intended(state, lifts, share)
        driven = self.person.drive(LIFTS, lifts.drawn, intention, references)
        differences, wrist = (jnp.broadcast_to(each, references.shape) for each in driven)
        if added is not None:
            references, wrist = references + added.height, wrist + added.pitch
        meant = Meant(jnp.clip(references, *REFERENCE_RANGE), differences, wrist)
        after = limited_command(LIFTS, state.command, action, action_limit(size * FRAME), STROKE)
        commands = ramp(state.command, after, size)
        table, ends = moved_table(state.table, lifts.body, meant, commands, lifts.arms)
        lost = state.lost
        if isinstance(self.task, Touch):
            now = jnp.broadcast_to(self.task.lost(LIFTS, ends), references.shape).any(axis=0)
            lost = jnp.maximum(lost, now.astype(lost.dtype))
        return LiftState(
            table=table,
            command=commands[-1],
            hand=hand,
            memory=memory,
            intentions=jax.tree.map(pushed, state.intentions, intention),
            lost=lost,
            step=state.step + 1,
        ), ends

    def intended(
        self, state: LiftState, lifts: Lifts, share: Share
    ) -> tuple[Any, Any, HandMemory[jax.Array], jax.Array]:
        """Return the people's memory after a step, their intention in it, and their hands.

        The last are their memory after the step, and the heights (f, n) that they pull towards [m].
        """
        view = LiftView(state, lifts, share.ages)
        memory, intention = self.person.intend(LIFTS, lifts.drawn, state.memory, view, lifts.frames)
        noise = HandNoise(share.gain, share.tremor)
        hand, references = carry_out(LIFTS, state.hand, view, intention.target, noise)
        return memory, intention, hand, cast(jax.Array, references)

    def dropped(self, state: LiftState, lifts: Lifts) -> jax.Array:
        """Return whether each table (n,) was dropped or lost in the step just made.

        The tests are those of :meth:`.Level.failure`, except that of the gap: the twin's hands
        never let go.
        """
        plant, steps = state.plant, self.task.physics.steps_per_frame
        pulled = pulled_off(LIFTS, plant.moving.pulled / steps, lifts.frames)
        fallen = jnp.logical_or(slides_off(LIFTS, plant.differences[0]), pulled)
        return jnp.logical_or(fallen, state.lost > 0)

    def missed(self, state: LiftState, after: LiftState, lifts: Lifts, ends: Ends) -> Missed:
        """Return the contributions of a step to the error, from the states before and after it.

        After a lift is lost, each frame of the steps that follow counts with
        :data:`.FAILED_FRAME_MM`, as in the engine, so that the loss is finite. Its gradient comes
        only from the frames until then.
        """
        lasts = state.step < lifts.steps
        squares = tuple(
            each
            if stay
            else jnp.where(state.lost > 0, lifts.frames * WORST, each.sum(axis=0)) * lasts
            for each, stay in zip(self.squares(state, lifts, ends), self.stays, strict=True)
        )
        left = jnp.where(after.step == lifts.steps, self.unfinished(after, lifts), 0.0)
        return Missed(squares, left)

    def squares(self, state: LiftState, lifts: Lifts, ends: Ends) -> Sequence[jax.Array]:
        """Return squares of the error in the frames (f, n) of a step from ``state`` on [m2]."""
        if not isinstance(self.task, Touch):
            return ((ends.near - ends.far) ** 2,)
        due = jax.tree.map(
            lambda series: series.next(state.step * lifts.frames, lifts.frames),
            lifts.drawn.series,
            is_leaf=lambda each: hasattr(each, "next"),
        )
        return self.task.missed(LIFTS, due, ends)

    def unfinished(self, state: LiftState, lifts: Lifts) -> jax.Array:
        """Return how many frames of the plan (n,) are still to be done."""
        view = LiftView(state, lifts, lifts.steps)
        if isinstance(self.task, Touch):
            left: jax.Array = self.task.unfinished(LIFTS, lifts.drawn, view)
            return left
        if "time" in self.person.intention._fields:
            return jnp.maximum(lifts.stop - view.seen("time", 0), 0.0)
        return jnp.zeros_like(state.command)

    def error(self, lifts: Lifts, squares: Sequence[jax.Array], frames: jax.Array) -> jax.Array:
        """Return the square of the error (n,) [m2] of gathered squares in the lifts' frames."""
        if isinstance(self.task, Touch):
            error: jax.Array = self.task.error(LIFTS, lifts.drawn.facts, squares, frames)
            return error
        return squares[0] / frames

    def score_mm(self, lifts: Lifts, missed: Missed) -> jax.Array:
        """Return the scores (n,) [mm] from the contributions of all steps, stacked.

        The rule is that of :meth:`.Touch.rmse_mm`.
        """
        squares = [
            gathered(each.reshape(-1, lifts.size), stay)
            for each, stay in zip(missed.squares, self.stays, strict=True)
        ]
        return self.scored_mm(lifts, squares, missed.unfinished.sum(axis=0))

    def scored_mm(
        self, lifts: Lifts, squares: Sequence[jax.Array], missing: jax.Array
    ) -> jax.Array:
        """Return the scores (n,) [mm] of gathered squares, and of frames that are missing."""
        frames = lifts.steps * lifts.frames
        square = square_at_end(self.error(lifts, squares, frames), frames, missing)
        return 1000 * jnp.sqrt(square + 1e-12)
