"""Ranks of a season, computed from the hidden episodes, and stored.

Nobody who reads a board waits for them: the stored ones stand until the next are there.
"""

import functools
import hashlib
import json
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final, Self

import sqlalchemy as sa
from colift.benchmark.statistics import Units, all_pairs, decisive
from colift.leaderboard.database.connection import Database
from colift.leaderboard.database.queries import read_errors
from colift.leaderboard.database.schema import rank_groups

METHOD: Final = 4
"""Version of the method; every change that can move a rank raises it."""

Scored = Mapping[str, Mapping[str, int]]
"""The submissions to rank, by section, each with the number of its valid ``hidden_errors``."""


@dataclass(frozen=True, eq=False)
class Ranks:
    """The ranks of a season that were computed last."""

    fingerprint: str = ""
    """Of the errors that they were computed from, see :func:`fingerprint`."""
    sections: tuple[tuple[str, ...], ...] = ()
    """The submissions of each section, best first."""
    ranks: Mapping[str, int] = field(default_factory=dict)
    """Rank of each submission: 1 is the best, 0 is none."""
    numbers: Mapping[str, int] = field(default_factory=dict)
    """Number of the errors of each submission."""

    def of(self, submission: str, number: int | None) -> int | None:
        """Return the rank of a submission with these errors; None if it has not been ranked."""
        same = number is not None and self.numbers.get(submission) == number
        return self.ranks[submission] if same else None

    @functools.cached_property
    def places(self) -> dict[str, int]:
        """Place of each submission, over all sections."""
        listed = (submission for section in self.sections for submission in section)
        return {submission: place for place, submission in enumerate(listed)}

    @functools.cached_property
    def _section(self) -> dict[str, int]:
        return {each: i for i, section in enumerate(self.sections) for each in section}

    @functools.cached_property
    def _sizes(self) -> Counter[tuple[int, int]]:
        return Counter((self._section[each], rank) for each, rank in self.ranks.items())

    def shared(self, submission: str) -> int:
        """Return the number of submissions that have the rank of one."""
        where = self._section.get(submission)
        return 1 if where is None else self._sizes[where, self.ranks[submission]]

    def fellows(self, submission: str) -> tuple[str, ...]:
        """Return the submissions that are ranked with one, best first."""
        where = self._section.get(submission)
        return () if where is None else self.sections[where]

    def plain(self) -> dict[str, Any]:
        """Return them as JSON, without the fingerprint."""
        return {
            "sections": [[[each, self.ranks[each]] for each in some] for some in self.sections],
            "numbers": dict(self.numbers),
        }

    @classmethod
    def read(cls, fingerprint: str, content: Any) -> Self:
        """Return the ranks from the output of :meth:`plain`; none from that of an older colift."""
        if not isinstance(content, dict):
            return cls()
        return cls(
            fingerprint=fingerprint,
            sections=tuple(tuple(each for each, _ in some) for some in content["sections"]),
            ranks={each: rank for some in content["sections"] for each, rank in some},
            numbers=content["numbers"],
        )


def fingerprint(scored: Scored) -> str:
    """Return the SHA-256 of what the ranks of some submissions follow from."""
    plain = {section: sorted(numbers.items()) for section, numbers in scored.items()}
    return hashlib.sha256(json.dumps([METHOD, plain]).encode()).hexdigest()


def compute_ranks(database: Database, season: str, scored: Scored, people: Units | None) -> None:
    """Compute and store the ranks of some submissions; each section is ranked by itself.

    See :attr:`.Family.ranks`. If the people are too few to tell any two apart, the rank is 0.

    Parameters
    ----------
    database, season, scored
        The season's submissions.
    people
        The people of its hidden lifts. Where they are not known, since no baseline has been played
        on these lifts, each lift counts as one person.
    """
    sections: list[tuple[str, ...]] = []
    ranks: dict[str, int] = {}
    for numbers in filter(None, scored.values()):
        with database.reading() as connection:
            errors = read_errors(connection, season, numbers)
        lifts = min((len(each) for each in errors.values()), default=0)
        known = people is not None and len(people.unit) == lifts
        units = people if people and known else Units.episodes(["hidden"] * lifts)
        found = all_pairs(errors, units).ranks
        told = decisive(units.count) or len(errors) == 1
        ranks |= {each: rank if told else 0 for each, rank in found.items()}
        sections.append(tuple(found))
    made = Ranks(
        sections=tuple(sections),
        ranks=ranks,
        numbers={each: number for some in scored.values() for each, number in some.items()},
    )
    mark = fingerprint(scored)
    with database.writing() as connection:
        connection.execute(sa.delete(rank_groups).where(rank_groups.c.season == season))
        content = {"season": season, "fingerprint": mark, "groups": made.plain()}
        connection.execute(sa.insert(rank_groups).values(**content))


def read_ranks(connection: sa.Connection, season: str, known: Ranks) -> Ranks:
    """Return the stored ranks of a season: ``known``, if they are those."""
    this = rank_groups.c.season == season
    mark = connection.scalar(sa.select(rank_groups.c.fingerprint).where(this))
    if mark == known.fingerprint:
        return known
    content = connection.scalar(sa.select(rank_groups.c.groups).where(this))
    return Ranks.read(mark or "", content)
