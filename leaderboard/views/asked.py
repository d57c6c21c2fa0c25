"""Questions of readers to a table: search, order, a part of the lifts, and a page of rows."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Self

from colift.benchmark.results.parts import Part

ROWS: Final = 100
"""Maximum number of rows of a page."""

LONGEST: Final = 200
"""Maximum length of a search [characters]."""

CHOSEN: Final = 4
"""Maximum number of policies that are compared at a time."""


@dataclass(frozen=True, kw_only=True)
class Asked:
    """A question to a table; by default its first rows."""

    search: str = ""
    """Words that name, authors, licence or method contain."""
    sort: str = "rank"
    """Name of a column; with a minus before it, the other way round."""
    behaviour: str = ""
    """The behaviour of whose public lifts numbers are shown; empty is all hidden lifts."""
    columns: str = ""
    """Name of a set of columns."""
    first: int = 0
    """Place of the first row that is shown."""
    chosen: tuple[str, ...] = ()
    """Submissions that are ticked, to be compared."""

    @classmethod
    def read(
        cls,
        *,
        q: str = "",
        sort: str = "",
        behaviour: str = "",
        columns: str = "",
        first: str = "",
        p: Sequence[str] = (),
    ) -> Self:
        """Return the question of an address; what makes no sense is left out."""
        return cls(
            search=" ".join(q[:LONGEST].split()),
            sort=sort or "rank",
            behaviour=behaviour,
            columns=columns if columns in ("behaviours", "about") else "",
            first=int(first) if first.isascii() and first.isdecimal() and len(first) < 10 else 0,
            chosen=tuple(dict.fromkeys(p))[:CHOSEN],
        )

    @property
    def part(self) -> Part | None:
        """The part of the public lifts, if one was asked for."""
        return Part(behaviour=self.behaviour) if self.behaviour else None

    @property
    def column(self) -> str:
        """Name of the column that the rows are sorted by."""
        return self.sort.removeprefix("-")

    @property
    def down(self) -> bool:
        """Whether they are sorted the other way round."""
        return self.sort.startswith("-")

    @property
    def plain(self) -> bool:
        """Whether it asks for all rows of the table in their order."""
        return not self.search and self.sort == "rank" and self.part is None
