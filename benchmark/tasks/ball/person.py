"""The person who steers the ball with one end of the table while lifting."""

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Final, Generic, NamedTuple

from colift.agents.agent import FRAME, HISTORY
from colift.agents.humans import Subject
from colift.agents.humans.person import Trait
from colift.agents.rules import ArrayFunctions, Drawn, N, View
from colift.agents.tasks.ball.facts import LENGTH
from colift.benchmark.tasks.ball.manner import TRAITS, SteeringManner, steering_manner
from colift.benchmark.tasks.ball.steering import (
    SQUARE,
    BallTarget,
    SteeringMemory,
    SteeringSenses,
    steer,
)

STEEPEST_MEANT: Final = 0.5
"""Largest sine of an intended pitch; people's intentions stay far below it."""

_HALF: Final = (HISTORY - 1) // 2


class SteeringIntention(NamedTuple, Generic[N]):
    """An intention: columns with a number for each frame."""

    target: Any
    """Height to which the hand goes, with the steering [m]."""
    plan: Any
    """Planned height [m]."""


class Steers:
    """A :class:`.Person` who lifts, and makes a share of the height difference that the ball needs.

    The task's series must have the intended ``place`` of the ball [m].
    """

    traits: ClassVar[Mapping[str, Trait]] = TRAITS
    shown: ClassVar[tuple[str, ...]] = ("wrist",)
    intention: ClassVar[Any] = SteeringIntention

    def draw(
        self, subject: Subject, seed: Callable[[str], int], steps: int, size: int
    ) -> tuple[tuple[()], SteeringManner[float]]:
        """Return the person's manner."""
        return (), steering_manner(subject)

    def begin(self, f: ArrayFunctions[N], zero: N, no: Any) -> SteeringMemory[N]:
        """Return the memory at the beginning."""
        return SteeringMemory(zero, zero, zero, zero + SQUARE)

    def intend(
        self, f: ArrayFunctions[N], drawn: Drawn[N], memory: Any, view: View[N], frames: int
    ) -> tuple[SteeringMemory[N], SteeringIntention[N]]:
        """Return the plan with the steering's offsets (:func:`.steer`)."""
        late, place = view.visual, drawn.series.place
        newest, oldest = (view.seen("ball_place", late + age) for age in (0, HISTORY - 1))
        senses = SteeringSenses(
            own=view.seen("human_end", late),
            other=view.seen("robot_end", late),
            planned=drawn.target.at(view.frame - 1 - late),
            place=newest,
            speed=(newest - oldest) / (FRAME * (HISTORY - 1)),
            target=BallTarget(*(place.at(view.frame + i * _HALF) for i in range(3))),
            span=_HALF * FRAME,
            known=0.0 * newest + 1.0,
            felt=0.0 * newest,
        )
        memory, offsets = steer(f, drawn.manner, memory, senses, -1.0, frames)
        plan = drawn.target.next(view.frame, frames)
        targets = f.column([height + offset for height, offset in zip(plan, offsets, strict=True)])
        return memory, SteeringIntention(targets, plan)

    def drive(
        self, f: ArrayFunctions[N], drawn: Drawn[N], intention: Any, reference: N
    ) -> tuple[N, N]:
        """Return the height difference that the own end makes, and the wrists' pitch for it."""
        own, limit = intention.plan - reference, STEEPEST_MEANT * LENGTH
        part = drawn.manner.wrist / drawn.manner.share
        return own, f.arcsin(f.clip(part * own, -limit, limit) / LENGTH)

    def knows(
        self, f: ArrayFunctions[N], drawn: Drawn[N], memory: Any, view: View[N], frames: int
    ) -> tuple[N, ...]:
        """Return the seen place of the ball, and its intended places now and after ten frames."""
        place = drawn.series.place
        return (
            5.0 * view.seen("ball_place", view.visual),
            5.0 * place.at(view.frame),
            5.0 * place.at(view.frame + HISTORY - 1),
        )
