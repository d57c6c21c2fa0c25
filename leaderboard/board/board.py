"""A board: its seasons, their entries, and what has happened to them.

What is where: :mod:`.store` for files, :mod:`.database.schema` for tables.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Self

from ...agents.errors import InputError
from ...agents.submissions.submission import Submission
from ..database.database import URL, Database
from ..database.queries import read_entries, read_events, record_errors, record_event
from ..database.schema import entries, events
from ..records.row import BoardRow
from ..records.season import BoardEntry, Event, Kind, Season, SeasonInfo
from ..storage.store import Store
from .seasons import Clock, ImportedSeason, SeasonBook, utc_now
from .standings import HumanTeamScores, RankedRow, frame, human_team, standings

if TYPE_CHECKING:
    from pandas import DataFrame

FIRST: Final = "1"
"""Name of a new board's season."""

SUITE: Final = "standard-v1"
"""What a new board evaluates on, if nothing else is said."""

SHIPPED: Final = "shipped"
"""Why a season from elsewhere is here, if nothing else is said."""

LOCAL: Final = "local"
"""Who does something, if nobody says who: whoever can write to the folder."""

OWN: Final = "colift"
"""Who submits the project's own policies: nobody's token has this name."""


@dataclass(frozen=True)
class Board:
    """A board that is there."""

    folder: Path
    database: Database = field(repr=False)
    clock: Clock = field(default=utc_now, repr=False)

    @classmethod
    def open(
        cls,
        folder: Path,
        suite: str | None = None,
        *,
        url: str | None = None,
        clock: Clock = utc_now,
        practice: ImportedSeason | None = None,
    ) -> Self:
        """Return the board in a folder; it is made if there is none.

        Parameters
        ----------
        folder
            Where it is; or where it shall be, a new or empty folder.
        suite
            Name of the suite that it must have; None takes any, and ``standard-v1`` for a new one.
        url
            A PostgreSQL database, ``postgresql://user@host/name``, instead of a file in the folder;
            by default that of the environment's ``COLIFT_DATABASE_URL``, if there is one.
        clock
            What time it is.
        practice
            What a new board begins with, if it takes submissions and is of the wanted suite;
            otherwise it begins with a season of its own.

        Raises
        ------
        InputError
            If something else is there, it cannot be written, it has another suite, or its database
            does not answer.
        """
        store, place = Store(folder.absolute()), url or os.environ.get(URL) or None
        try:
            store.prepare("PostgreSQL" if place else "SQLite")
            with store.alone():
                board = cls(store.folder, Database.open(store.folder, place), clock)
                with board._closed_on_error():
                    board._ready(suite, practice)
        except OSError as error:
            raise InputError(f"cannot use {folder} as a board: {error.strerror}") from error
        return board

    @classmethod
    def look(cls, folder: Path, url: str | None = None) -> Self:
        """Return the board in a folder that cannot be written, to be read.

        Raises
        ------
        InputError
            If there is none, or it cannot be read.
        """
        store, place = Store(folder.absolute()), url or os.environ.get(URL) or None
        try:
            store.check("PostgreSQL" if place else "SQLite")
            return cls(store.folder, Database.look(store.folder, place))
        except OSError as error:
            raise InputError(f"cannot read the board {folder}: {error.strerror}") from error

    def close(self) -> None:
        """Close the connections to the database."""
        self.database.close()

    @property
    def store(self) -> Store:
        """The board's files."""
        return Store(self.folder)

    @property
    def season(self) -> Season:
        """The season that submissions are evaluated in now; see :meth:`season_of`."""
        return self.season_of(self._book.current().name)

    def season_of(self, name: str) -> Season:
        """Return what submissions to a season are evaluated on.

        Raises
        ------
        InputError
            If there is no such season, it is one of a colift of other rules, or its secret is not
            the one that was committed to.
        """
        return self._book.playable(name)

    def seasons(self) -> tuple[SeasonInfo, ...]:
        """Return all seasons in the order in which they came."""
        return self._book.read()

    def new_season(self, name: str, suite: str | None = None, who: str = LOCAL) -> Season:
        """Begin a season, with a new secret; the rows so far stay, in their own table.

        Parameters
        ----------
        name
            What it is called.
        suite
            Name of its suite; by default as so far.
        who
            Who begins it.

        Raises
        ------
        InputError
            If there has been a season of that name, or it is no name.
        """
        with self.store.alone():
            self._book.begin(name, suite or self._book.current().suite, who)
        return self.season

    def reveal(self, season: str, who: str, why: str) -> None:
        """Publish the secret of a season, for good.

        Raises
        ------
        InputError
            If the season still takes submissions.
        """
        self._book.reveal(season, who, why)

    def adopt(self, practice: ImportedSeason, who: str = LOCAL, why: str = SHIPPED) -> None:
        """Take over a season that was played elsewhere, with its rows; nothing if it is there.

        Raises
        ------
        InputError
            If its secret is not the one it is committed to.
        """
        with self.store.alone():
            self._book.adopt(practice, who, why)

    def standings(self, season: str | None = None) -> tuple[RankedRow, ...]:
        """Return the table of a season, best first; rows out of the ranking are at the end.

        Ranks follow from the hidden episodes, lift by lift; see :func:`.rank_groups`. The number
        of queries does not depend on that of the entries.

        Parameters
        ----------
        season
            Its name; by default the current one.

        Raises
        ------
        InputError
            If there is no such season.
        """
        return standings(self.database, self.season_info(season).name)

    def ranking(self, season: str | None = None) -> "DataFrame":
        """Return the ranked rows of a season as a data frame, best first.

        Its columns are :data:`.standings.COLUMNS`: RMSE and ratio to the human-human team are those
        of the hidden episodes.

        Raises
        ------
        InputError
            If there is no such season, or pandas is not installed.
        """
        return frame(self.standings(season))

    def team(self, season: str | None = None) -> HumanTeamScores | None:
        """Return the human-human team on a season's hidden episodes; None before the first row."""
        known = self.store.vault(self.season_info(season).name).known_team()
        return None if known is None else human_team(known)

    def entry(self, season: str, digest: str) -> BoardEntry | None:
        """Return what the board said of a submission, or None if it has not been evaluated."""
        this = (entries.c.season == season, entries.c.submission == digest)
        with self.database.reading() as connection:
            return next(iter(read_entries(connection, *this)), None)

    def entries_of(self, name: str) -> tuple[BoardEntry, ...]:
        """Return the entries of a policy's name over all seasons, oldest first."""
        with self.database.reading() as connection:
            return read_entries(connection, entries.c.name == name)

    def events(self, season: str | None = None, submission: str | None = None) -> tuple[Event, ...]:
        """Return what has happened, oldest first: to a season, to a submission, or at all."""
        wanted = {events.c.season: season, events.c.submission: submission}
        conditions = [column == value for column, value in wanted.items() if value is not None]
        with self.database.reading() as connection:
            return read_events(connection, *conditions)

    def withdraw(self, season: str, digest: str, who: str, why: str) -> None:
        """Take a row out of the ranking at its submitter's request; it stays visible.

        Raises
        ------
        InputError
            If the submission has no row in that season.
        """
        self._change(season, digest, "withdrawal", who, why)

    def remove(self, season: str, digest: str, who: str, why: str) -> None:
        """Take a row out of the ranking at the maintainer's request; it stays visible."""
        self._change(season, digest, "removal", who, why)

    def reinstate(self, season: str, digest: str, who: str, why: str) -> None:
        """Take a withdrawn or removed row back into the ranking."""
        self._change(season, digest, "reinstatement", who, why)

    def rescore(
        self, season: str, row: BoardRow, hidden_rmse_mm: tuple[float, ...], who: str, why: str
    ) -> None:
        """Say what a row is after a mistake in its evaluation; the entry stays as it was.

        Parameters
        ----------
        season
            Its season.
        row
            The row as it is right, of the same submission.
        hidden_rmse_mm
            RMSE of each hidden episode, as it is right.
        who, why
            Who says so, and for which reason.

        Raises
        ------
        InputError
            If the submission has no row in that season.
        """
        content = {"row": row.plain()}
        self._change(season, row.submission, "rescore", who, why, content, hidden_rmse_mm)

    def bundle(self, season: str, digest: str) -> Path | None:
        """Return the folder of a submission's public run, or None if the board has none."""
        place = self.store.bundle(season, digest)
        return place if place.is_dir() else None

    def keep(self, folder: Path) -> Submission:
        """Copy a submission into the board, under its digest; what is there is left as it is.

        Raises
        ------
        InputError
            If it is not what a submission must be.
        """
        return self.store.keep(folder)

    def _ready(self, suite: str | None, practice: ImportedSeason | None) -> None:
        """Begin the first season, if there is none; refuse another suite than that of a board."""
        if not self.seasons():
            wanted = suite or SUITE
            if practice and practice.info.current and practice.info.suite == wanted:
                self._book.adopt(practice, LOCAL, SHIPPED)
            else:
                self._book.begin(FIRST, wanted, LOCAL)
        current = self._book.current()
        if suite not in (None, current.suite):
            raise InputError(f"{self.folder} is a board of {current.suite}, not of {suite}")
        self.store.vault(current.name).secret()

    @contextmanager
    def _closed_on_error(self) -> Iterator[None]:
        try:
            yield
        except BaseException:
            self.close()
            raise

    @property
    def _book(self) -> SeasonBook:
        return SeasonBook(self.store, self.database, self.clock)

    def season_info(self, season: str | None = None) -> SeasonInfo:
        """Return what is published of a season, by default of the current one.

        Raises
        ------
        InputError
            If there is no such season.
        """
        return self._book.current() if season is None else self._book.named(season)

    def _change(
        self,
        season: str,
        digest: str,
        kind: Kind,
        who: str,
        why: str,
        content: dict[str, Any] | None = None,
        hidden_rmse_mm: tuple[float, ...] = (),
    ) -> None:
        entry = self.entry(season, digest)
        if entry is None or entry.row is None:
            raise InputError(f"season {season} of {self.folder} has no row of submission {digest}")
        event = Event(
            at=self.clock(),
            who=who,
            kind=kind,
            why=why,
            season=season,
            submission=digest,
            content=content,
        )
        with self.database.writing() as connection:
            record_event(connection, event)
            if hidden_rmse_mm:
                record_errors(connection, season, digest, hidden_rmse_mm)
