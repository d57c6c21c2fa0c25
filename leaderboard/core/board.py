"""A board: its seasons, their entries and their events.

Its files are described in :mod:`.store`, its tables in :mod:`.database.schema`.
"""

import functools
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Final, Self

from colift.agents.submissions.submission import Submission
from colift.base.errors import InputError
from colift.base.registry import LEADING_SUITES
from colift.leaderboard.core.seasons import Clock, ImportedSeason, SeasonBook, utc_now
from colift.leaderboard.core.standings import (
    RankedRow,
    UnrankedScores,
    frame,
    unranked_scores,
)
from colift.leaderboard.core.tables import Tables
from colift.leaderboard.database.connection import URL, Database
from colift.leaderboard.database.queries import read_entries, read_events
from colift.leaderboard.database.room import NoRoomError, is_full
from colift.leaderboard.database.schema import entries, events
from colift.leaderboard.records.season import (
    BoardEntry,
    Event,
    Season,
    SeasonInfo,
    check_season_suite,
)
from colift.leaderboard.storage.store import Store

if TYPE_CHECKING:
    from pandas import DataFrame

FIRST: Final = "1"
"""Name of a new board's season."""

SUITE: Final = LEADING_SUITES[0]
"""Default suite of a new board."""

IMPORTED: Final = "imported practice season"
"""Default reason of a season import."""

LOCAL: Final = "local"
"""Default actor: anyone who can write to the folder."""

BUILTIN: Final = "colift"
"""Submitter of the built-in policies; no token has this name."""


@dataclass(frozen=True)
class Board:
    """An open board."""

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
        """Open the board in a folder; create it if there is none.

        Parameters
        ----------
        folder
            The board's folder, or a new or empty one.
        suite
            Name of the required suite; None accepts any, and is :data:`SUITE` for a new board.
        url
            A PostgreSQL database, ``postgresql://user@host/name``, instead of a file in the folder;
            by default that of the environment's ``COLIFT_DATABASE_URL``, if there is one.
        clock
            Returns the time.
        practice
            First season of a new board, if it takes submissions and has the required suite;
            otherwise the first season is a new one with its own secret.

        Raises
        ------
        NoRoomError
            If its disk is full.
        InputError
            If the folder has other content or cannot be written to, the board has another suite, or
            its database does not answer.
        """
        store, place = Store(folder.absolute()), url or os.environ.get(URL) or None
        try:
            store.prepare("PostgreSQL" if place else "SQLite")
            with store.alone():
                board = cls(store.folder, Database.open(store.folder, place), clock)
                with board._closed_on_error():
                    board._ready(suite, practice)
        except OSError as error:
            if is_full(error):
                raise NoRoomError(folder) from error
            raise InputError(f"cannot use {folder} as a board: {error.strerror}") from error
        return board

    @classmethod
    def look(cls, folder: Path, url: str | None = None) -> Self:
        """Open the board in a read-only folder.

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
            if is_full(error):
                raise NoRoomError(Path(tempfile.gettempdir())) from error
            raise InputError(f"cannot read the board {folder}: {error.strerror}") from error

    def close(self) -> None:
        """Close the connections to the database."""
        self.database.close()

    @property
    def store(self) -> Store:
        """The board's files."""
        return Store(self.folder)

    @functools.cached_property
    def tables(self) -> Tables:
        """The tables of the seasons, kept in memory."""
        return Tables(self.database, self.store)

    @property
    def season(self) -> Season:
        """The current season; see :meth:`season_of`."""
        return self.season_of(self._book.current().name)

    def season_of(self, name: str) -> Season:
        """Return the suite and secret of a season.

        Raises
        ------
        InputError
            If there is no such season, its suite differs from this colift's, or its secret does not
            match the commitment.
        """
        return self._book.playable(name)

    def seasons(self) -> tuple[SeasonInfo, ...]:
        """Return all seasons, oldest first."""
        return self._book.read()

    def new_season(self, name: str, suite: str | None = None, who: str = LOCAL) -> Season:
        """Begin a season with a new secret; earlier rows stay in their own table.

        Parameters
        ----------
        name
            Its name.
        suite
            Name of its suite; by default that of the current season.
        who
            The actor.

        Raises
        ------
        InputError
            If the name is taken or malformed.
        """
        with self.store.alone():
            self._book.begin(name, suite or self._book.current().suite, who)
        return self.season

    def reveal(self, season: str, who: str, why: str) -> None:
        """Publish the secret of a season; this cannot be undone.

        Raises
        ------
        InputError
            If the season still takes submissions.
        """
        self._book.reveal(season, who, why)

    def import_season(
        self, practice: ImportedSeason, who: str = LOCAL, why: str = IMPORTED
    ) -> None:
        """Import a season with its rows; do nothing if the board has it.

        Raises
        ------
        InputError
            If its secret does not match the commitment.
        """
        with self.store.alone():
            self._book.import_season(practice, who, why)
        self.tables.ranked(practice.info.name)

    def standings(self, season: str | None = None) -> tuple[RankedRow, ...]:
        """Return the table of a season, best first; rows out of the ranking are at the end.

        Ranks follow from the hidden episodes, lift by lift; see :func:`.all_pairs`. They are
        computed if that has not been done yet; ``tables`` has the table without this wait.

        Parameters
        ----------
        season
            Its name; by default the current one.

        Raises
        ------
        InputError
            If there is no such season.
        """
        return self.tables.ranked(self.season_info(season).name).rows

    def ranking(self, season: str | None = None) -> "DataFrame":
        """Return the ranked rows of a season as a data frame, best first.

        Its columns are :func:`.standings.columns`: RMSE and its ratio to two people
        are those of the hidden episodes.

        Raises
        ------
        InputError
            If there is no such season, or pandas is not installed.
        """
        return frame(self.standings(season), self.season_info(season).suite)

    def human_human(self, season: str | None = None) -> UnrankedScores | None:
        """Return a season's human-human baseline on hidden episodes; None before the first row."""
        info = self.season_info(season)
        known = self.store.secrets(info.name).known_human_human()
        return None if known is None else unranked_scores(known, known, info.suite)

    def references(self, season: str | None = None) -> dict[str, UnrankedScores]:
        """Return a season's references on hidden episodes by name; none until they are played."""
        info = self.season_info(season)
        secrets = self.store.secrets(info.name)
        human_human = secrets.known_human_human()
        if human_human is None:
            return {}
        return {
            name: unranked_scores(scores, human_human, info.suite)
            for name, scores in secrets.known_references().items()
        }

    def entry(self, season: str, digest: str) -> BoardEntry | None:
        """Return the entry of a submission, or None if it has not been evaluated."""
        this = (entries.c.season == season, entries.c.submission == digest)
        with self.database.reading() as connection:
            return next(iter(read_entries(connection, *this)), None)

    def entries_of(self, name: str) -> tuple[BoardEntry, ...]:
        """Return the entries of a policy's name over all seasons, oldest first."""
        with self.database.reading() as connection:
            return read_entries(connection, entries.c.name == name)

    def events(
        self, season: str | None = None, submission: str | None = None, newest: int | None = None
    ) -> tuple[Event, ...]:
        """Return the events of a season, of a submission, or all, oldest first.

        With a number, return at most so many, the newest first.
        """
        wanted = {events.c.season: season, events.c.submission: submission}
        conditions = [column == value for column, value in wanted.items() if value is not None]
        with self.database.reading() as connection:
            return read_events(connection, *conditions, newest=newest)

    def bundle(self, season: str, digest: str) -> Path | None:
        """Return the folder of a submission's public run, or None if the board has none."""
        place = self.store.bundle(season, digest)
        return place if place.is_dir() else None

    def keep(self, folder: Path) -> Submission:
        """Copy a submission into the board, under its digest, unless it is there.

        Raises
        ------
        InputError
            If the submission is malformed.
        """
        return self.store.keep(folder)

    def _ready(self, suite: str | None, practice: ImportedSeason | None) -> None:
        """Begin the first season if there is none; refuse a suite that is not the board's."""
        if not self.seasons():
            wanted = suite or SUITE
            if practice and practice.info.current and practice.info.suite == wanted:
                self._book.import_season(practice, LOCAL, IMPORTED)
                self.tables.ranked(practice.info.name)
            else:
                self._book.begin(FIRST, wanted, LOCAL)
        current = self._book.current()
        check_season_suite(self.folder, current.suite, suite)
        self.store.secrets(current.name).secret()

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
        """Return the published facts of a season, by default of the current one.

        Raises
        ------
        InputError
            If there is no such season.
        """
        return self._book.current() if season is None else self._book.named(season)
