"""A person's recorded lifts in a row."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Self

from colift.agents.humans.recorded import Recorded
from colift.agents.humans.recordings import Recording
from colift.agents.humans.subject import Subject
from colift.base.errors import InputError

NAMELESS: Final = "person"
"""The person of all lifts of a file that names nobody."""

COUNTED: Final = 3
"""Most lifts at the end of a series that count."""


@dataclass(frozen=True, kw_only=True)
class RecordedSeries(Recorded):
    """Moves as a person was recorded to move in each lift of a series (:class:`.Recorded`).

    What the partner does changes the table, and not what was recorded.
    """

    lifts: tuple[Recording, ...]
    """The recordings of one person, in their order; ``recording`` is the one at the place."""
    place: int = 0
    """Place of the lift in the session, counted from 0."""

    @classmethod
    def of(cls, lifts: tuple[Recording, ...]) -> Self:
        """Return the series that begins with the first lift."""
        return cls(recording=lifts[0], lifts=lifts)

    @property
    def counted(self) -> int:
        """Lifts at the end of the session that count: the last three, and never the first."""
        return min(COUNTED, max(len(self.lifts) - 1, 1))

    @property
    def trust(self) -> None:
        """Nobody knows what a recorded person thinks of another partner."""

    def change(self, subject: Subject) -> None:
        """Nobody knows what a recorded person changes."""

    def at(self, place: int) -> Self:
        """Return the behaviour in the lift at a place.

        Raises
        ------
        InputError
            If no lift was recorded there.
        """
        if not 0 <= place < len(self.lifts):
            raise InputError(f"a session of {len(self.lifts)} recorded lifts has none at {place}")
        return dataclasses.replace(self, recording=self.lifts[place], place=place)

    def after(self, near: Sequence[float], far: Sequence[float]) -> Self:
        """Return the behaviour in the next lift; the last one is followed by itself."""
        return self.at(min(self.place + 1, len(self.lifts) - 1))


def names_people(recordings: Sequence[Recording]) -> bool:
    """Return whether any recording names its person."""
    return any(recording.person for recording in recordings)


def series_of(recordings: Sequence[Recording]) -> dict[str, RecordedSeries]:
    """Return the series of each person with several lifts, by the person's name.

    All have as many lifts as the person with the fewest. If nobody is named, all lifts are one
    person's, ``person``; beside people with names, lifts without one are in no series.
    """
    named = names_people(recordings)
    people: dict[str, list[Recording]] = {}
    for recording in recordings:
        if recording.person or not named:
            people.setdefault(recording.person or NAMELESS, []).append(recording)
    several = {name: lifts for name, lifts in people.items() if len(lifts) > 1}
    fewest = min(map(len, several.values()), default=0)
    return {name: RecordedSeries.of(tuple(lifts[:fewest])) for name, lifts in several.items()}
