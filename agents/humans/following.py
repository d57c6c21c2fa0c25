"""The person who goes along a plan, whatever the far end does."""

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Final, Generic, NamedTuple

from colift.agents.humans.person import Trait
from colift.agents.humans.subject import Subject
from colift.agents.rules import ArrayFunctions, Drawn, N, View


class Along(NamedTuple, Generic[N]):
    """An intention: a column with a number for each frame."""

    target: Any
    """Height to which the hand goes [m]."""


class FollowsPlan:
    """A :class:`.Person` whose intention is the plan, with level wrists and no manner."""

    traits: ClassVar[Mapping[str, Trait]] = {}
    shown: ClassVar[tuple[str, ...]] = ()
    intention: ClassVar[Any] = Along

    def draw(self, subject: Subject, seed: Callable[[str], int], steps: int, size: int) -> Any:
        """Return nothing."""
        return (), ()

    def begin(self, f: ArrayFunctions[N], zero: N, no: Any) -> Any:
        """Return no memory."""
        return ()

    def intend(
        self, f: ArrayFunctions[N], drawn: Drawn[N], memory: Any, view: View[N], frames: int
    ) -> tuple[Any, Any]:
        """Return the planned heights."""
        return memory, Along(drawn.target.next(view.frame, frames))

    def drive(
        self, f: ArrayFunctions[N], drawn: Drawn[N], intention: Any, reference: N
    ) -> tuple[N, N]:
        """Return a level table, and level wrists."""
        level = reference - reference
        return level, level

    def knows(
        self, f: ArrayFunctions[N], drawn: Drawn[N], memory: Any, view: View[N], frames: int
    ) -> tuple[N, ...]:
        """Return the planned height at the end of the step."""
        return (10.0 * drawn.target.at(view.frame + frames - 1),)


FOLLOWS_PLAN: Final = FollowsPlan()
