"""The person who goes along a plan, and slows down for a far end that lags."""

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Final, Generic, NamedTuple

from colift.agents.humans import Subject
from colift.agents.humans.following import FollowsPlan
from colift.agents.humans.person import Trait
from colift.agents.rules import ArrayFunctions, Drawn, N, View, at_time
from colift.benchmark.tasks.intent.pace import PaceMemory, PaceSenses, pace
from colift.benchmark.tasks.robust.habits import HABITS, habits_of

UNMOVED: Final = 1e6
"""Patience of a person who never slows down [m]."""


class Patience(NamedTuple, Generic[N]):
    """The manner of a person who slows down."""

    patience: N
    """Height difference of the ends [m] beyond which the person slows down; the person waits at
    twice this difference."""


class Paced(NamedTuple, Generic[N]):
    """An intention: columns with a number for each frame."""

    target: Any
    """Height to which the hand goes [m]."""
    time: Any
    """Time within the plan, in frames."""


class SlowsDown(FollowsPlan):
    """A :class:`.Person` whose pace depends on the far end (:func:`.pace`); the wrists are level.

    The far end is where it should be if it is as high as the own end was meant to be.
    """

    traits: ClassVar[Mapping[str, Trait]] = {"patience": HABITS["patience"]}
    intention: ClassVar[Any] = Paced

    def draw(
        self, subject: Subject, seed: Callable[[str], int], steps: int, size: int
    ) -> tuple[tuple[()], Patience[float]]:
        """Return the person's patience."""
        return (), Patience(habits_of(subject).patience)

    def begin(self, f: ArrayFunctions[N], zero: N, no: Any) -> PaceMemory[N]:
        """Return the memory at the beginning."""
        return PaceMemory(zero, zero)

    def intend(
        self, f: ArrayFunctions[N], drawn: Drawn[N], memory: Any, view: View[N], frames: int
    ) -> tuple[Any, Any]:
        """Return the planned heights at the person's times within the plan."""
        late = view.visual
        senses = PaceSenses(view.seen("robot_end", late), view.seen("target", late))
        memory, times = pace(f, drawn.manner, memory, senses, frames)
        target = drawn.target
        return memory, f.along(lambda time: Paced(at_time(f, target, time), time), f.column(times))


SLOWS_DOWN: Final = SlowsDown()
