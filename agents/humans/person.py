"""The rules of a person at the near end: one text for one lift in the engine and n in the twin."""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from colift.agents.humans.subject import Subject
from colift.agents.rules import ArrayFunctions, Drawn, N, View


class Person(Protocol):
    """How people carry out a plan, and act on what they see and feel.

    All functions are pure: what changes is in the memory, a named tuple of numbers.
    """

    @property
    def traits(self) -> Mapping[str, "Trait"]:
        """The population's range of each number of a manner, in the manner's order."""

    @property
    def shown(self) -> tuple[str, ...]:
        """Names of the traits by which the wrists show the intention; 0 shows nothing."""

    @property
    def intention(self) -> Any:
        """The named tuple of an intention; see :meth:`intend`."""

    def draw(self, subject: Subject, seed: Callable[[str], int], steps: int, size: int) -> Any:
        """Return what is drawn for a person and a lift: two named tuples.

        Parameters
        ----------
        subject
            The person.
        seed
            Returns the lift's seed of a role.
        steps, size
            Steps of the lift, and frames in each.

        Returns
        -------
        tuple
            Series, arrays (steps * size,), and the numbers of the person's manner.
        """

    def begin(self, f: ArrayFunctions[N], zero: N, no: Any) -> Any:
        """Return the memory at the beginning, of a number 0 and a truth False."""

    def intend(
        self, f: ArrayFunctions[N], drawn: Drawn[N], memory: Any, view: View[N], frames: int
    ) -> Any:
        """Return the memory after a step of ``frames`` frames, and the intention in it.

        The intention is a named tuple of columns, with an entry for each frame. Its ``target`` is
        the height to which the hand goes [m].
        """

    def drive(self, f: ArrayFunctions[N], drawn: Drawn[N], intention: Any, reference: N) -> Any:
        """Return the intended height difference [m] and the wrists' pitch [rad] in a frame.

        Parameters
        ----------
        intention
            That of the frame.
        reference
            The height that the arms pull towards [m].
        """

    def knows(
        self, f: ArrayFunctions[N], drawn: Drawn[N], memory: Any, view: View[N], frames: int
    ) -> Any:
        """Return what a person knows about the task before a step: numbers of the order of 1.

        A person who learns has them as inputs (``colift.benchmark.training.pairs``).
        """


@runtime_checkable
class Attentive(Protocol):
    """A behaviour whose people have rules of their own, instead of those of the task.

    It is for tasks whose people follow their plan whatever happens (:data:`.FOLLOWS_PLAN`).
    """

    @property
    def rules(self) -> Person:
        """The rules of its people."""


class Trait(NamedTuple):
    """The range of a number of people's manners, in which it is uniform."""

    low: float
    high: float
    least: float = float("-inf")
    """Limits of people from wider ranges, to learn from."""
    most: float = float("inf")
    wider: bool = True
    """Whether there are such people."""


def drawn_traits(traits: Mapping[str, Trait], subject: Subject, salt: int) -> dict[str, float]:
    """Return a person's numbers of a manner, drawn by the person's name.

    Parameters
    ----------
    traits
        Their ranges, in order.
    subject
        The person: ``draw-N``, or anybody else, who is as ``draw-0``.
    salt
        Distinguishes this draw from others with the same name.
    """
    kind, _, number = subject.name.partition("-")
    seed = int(number) if kind == "draw" and number.isdecimal() else 0
    shares = np.random.default_rng((seed, salt)).random(len(traits)).tolist()
    return {
        name: trait.low + (trait.high - trait.low) * share
        for (name, trait), share in zip(traits.items(), shares, strict=True)
    }
