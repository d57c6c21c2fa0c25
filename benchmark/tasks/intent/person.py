"""The person who leads the table to a pose, and waits for the far end."""

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Final, Generic, NamedTuple

from colift.agents.humans import Subject
from colift.agents.humans.person import Trait
from colift.agents.rules import ArrayFunctions, Drawn, N, View, at_time
from colift.agents.tasks.ball.facts import LENGTH
from colift.benchmark.tasks.intent.manner import TRAITS, LeadingManner, leading_manner
from colift.benchmark.tasks.intent.pace import PaceMemory, PaceSenses, PosePath, intended, pace

LOOKS_AHEAD: Final = (10.0, 30.0, 60.0)
"""Frames ahead at which learning people know their intention."""


class LeadingIntention(NamedTuple, Generic[N]):
    """An intention: columns with a number for each frame."""

    target: Any
    """Height to which the hand goes [m]."""
    far: Any
    """Intended height of the far end [m]."""
    pitch: Any
    """Pitch that the wrists turn towards [rad]."""
    time: Any
    """Time within the plan, in frames."""


class Leads:
    """A :class:`.Person` who goes through a plan of both ends at a variable pace (:func:`.pace`).

    The task's series must have the planned height of the ``far`` end [m].
    """

    traits: ClassVar[Mapping[str, Trait]] = TRAITS
    shown: ClassVar[tuple[str, ...]] = ("wrist",)
    intention: ClassVar[Any] = LeadingIntention

    def draw(
        self, subject: Subject, seed: Callable[[str], int], steps: int, size: int
    ) -> tuple[tuple[()], LeadingManner[float]]:
        """Return the person's manner."""
        return (), leading_manner(subject)

    def begin(self, f: ArrayFunctions[N], zero: N, no: Any) -> PaceMemory[N]:
        """Return the memory at the beginning."""
        return PaceMemory(zero, zero)

    def intend(
        self, f: ArrayFunctions[N], drawn: Drawn[N], memory: Any, view: View[N], frames: int
    ) -> tuple[PaceMemory[N], LeadingIntention[N]]:
        """Return the poses at the person's times within the plan (:func:`.intended`)."""
        senses = PaceSenses(view.seen("robot_end", view.visual), view.seen("far", view.visual))
        memory, times = pace(f, drawn.manner, memory, senses, frames)
        path = PosePath(drawn.target, drawn.series.far)
        pose = f.along(lambda time: intended(f, drawn.manner, path, time, LENGTH), f.column(times))
        return memory, LeadingIntention(*pose, f.column(times))

    def drive(
        self, f: ArrayFunctions[N], drawn: Drawn[N], intention: Any, reference: N
    ) -> tuple[N, N]:
        """Return the difference of the intended heights, and the pitch."""
        return intention.far - intention.target, intention.pitch

    def knows(
        self, f: ArrayFunctions[N], drawn: Drawn[N], memory: Any, view: View[N], frames: int
    ) -> tuple[N, ...]:
        """Return the intended heights of the own end at three times ahead, then differences."""
        times = [memory.time + ahead for ahead in LOOKS_AHEAD]
        near: list[Any] = [at_time(f, drawn.target, time) for time in times]
        far: list[Any] = [at_time(f, drawn.series.far, time) for time in times]
        apart: list[Any] = [20.0 * (b - a) for a, b in zip(near, far, strict=True)]
        return (*(10.0 * height for height in near), *apart)
