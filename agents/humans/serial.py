"""People who remember: a behaviour that changes from lift to lift of a session."""

from collections.abc import Sequence
from typing import Protocol, Self, runtime_checkable

from colift.agents.humans.plan import Behaviour
from colift.agents.humans.subject import Subject


@runtime_checkable
class Serial(Behaviour, Protocol):
    """A behaviour over the lifts of a session: ten lifts with the same partner, for example.

    In a suite, a scenario with such a behaviour is one session: its seeds are its lifts, in order.
    The plan of a lift depends on its place alone; how the person carries it out may depend on the
    lifts before.
    """

    @property
    def place(self) -> int:
        """Place of the lift in the session, counted from 0."""

    @property
    def counted(self) -> int:
        """Lifts at the end of a session that count; those before are to get to know each other."""

    @property
    def trust(self) -> float | None:
        """Trust in the partner before this lift, from 0 to 1; None if nobody knows it."""

    def change(self, subject: Subject) -> int | None:
        """Return the place of the lift from which on a habit is another one; None if none is."""

    def at(self, place: int) -> Self:
        """Return the behaviour in the lift at a place, of a person who has learned nothing."""

    def after(self, near: Sequence[float], far: Sequence[float]) -> Self:
        """Return the behaviour in the next lift.

        Parameters
        ----------
        near, far
            Height of the person's end and of the other one in each frame of this lift [m].
        """
