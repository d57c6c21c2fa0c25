"""The connection to a board's database: a SQLite file in its folder, or a PostgreSQL server."""

import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Final, Self

import sqlalchemy as sa
from colift.base.errors import InputError
from colift.base.extras import how_to_install
from colift.leaderboard.database.migration import migrate
from colift.leaderboard.database.room import NoRoomError, folder_with_room, is_full
from colift.leaderboard.database.transactions import database_time, make_engine, reading, writing

URL: Final = "COLIFT_DATABASE_URL"
"""Environment variable that names another database than the file in the board's folder."""

FILE: Final = "board.sqlite"
"""That file."""

AWAY: Final = (sa.exc.OperationalError, sa.exc.InterfaceError, sa.exc.TimeoutError)
"""Errors that are raised when the database is away, or has no free connection."""

SERVERS: Final = ("postgresql", "postgres", "postgresql+psycopg")
"""Schemes that the variable may have before ``://``."""


class DatabaseAwayError(InputError):
    """A database server does not answer; that may end."""


@dataclass(frozen=True)
class Database:
    """An open database with the tables of this version of colift."""

    engine: sa.Engine
    copy: "tempfile.TemporaryDirectory[str] | None" = None
    """Folder of the file, if it is a copy of a read-only board's."""

    @classmethod
    def open(cls, folder: Path, url: str | None = None) -> Self:
        """Return the database of the board in a folder; create or update its tables.

        Parameters
        ----------
        folder
            The board's folder.
        url
            Another database; None is the file in the folder.

        Raises
        ------
        DatabaseAwayError
            If a server does not answer.
        NoRoomError
            If its disk is full.
        InputError
            If there is no such database, or a later colift made it.
        """
        place = _url(url) if url else sa.URL.create("sqlite", database=str(folder / FILE))
        shown = place.render_as_string(hide_password=True)
        if place.get_backend_name() == "sqlite":
            (folder / FILE).touch(mode=0o600)  # It holds hidden scores.
        try:
            engine = make_engine(place)
        except ImportError:
            raise InputError(f"{shown} needs psycopg: {how_to_install('board')}") from None
        try:
            migrate(engine, shown)
        except sa.exc.DBAPIError as error:
            engine.dispose()
            if is_full(error, folder):
                raise NoRoomError(folder) from error
            away = engine.dialect.name != "sqlite" and isinstance(error, AWAY)
            kind = DatabaseAwayError if away else InputError
            raise kind(f"database {shown} cannot be opened: {error.orig}") from error
        except InputError:
            engine.dispose()
            raise
        return cls(engine)

    @classmethod
    def look(cls, folder: Path, url: str | None = None) -> Self:
        """Return the database of a board in a folder that cannot be written to.

        SQLite needs to write beside the file in order to read it, so a copy is opened, in a folder
        with room for it.
        """
        if url:
            return cls.open(folder, url)
        files = [folder / name for name in (FILE, f"{FILE}-wal") if (folder / name).exists()]
        room = folder_with_room(2 * sum(file.stat().st_size for file in files))
        copy = tempfile.TemporaryDirectory(prefix="colift-", dir=room)
        try:
            for file in files:
                shutil.copyfile(file, Path(copy.name, file.name))
            return cls(cls.open(Path(copy.name)).engine, copy)
        except BaseException:
            copy.cleanup()
            raise

    @contextmanager
    def reading(self) -> Iterator[sa.Connection]:
        """Yield a connection that sees one state of the database."""
        with reading(self.engine) as connection:
            yield connection

    @contextmanager
    def writing(self) -> Iterator[sa.Connection]:
        """Yield a connection whose changes are made as a whole, or not at all.

        There is only one writer at a time, as in SQLite, so what it has read stays true.
        """
        with writing(self.engine) as connection:
            yield connection

    def now(self, connection: sa.Connection) -> datetime:
        """Return the time of the database.

        Times that machines compare, such as those of leases, are all of this clock: the machines'
        own may differ by any amount.
        """
        return database_time(connection)

    def close(self) -> None:
        """Close all connections."""
        self.engine.dispose()
        if self.copy is not None:
            self.copy.cleanup()


def _url(text: str) -> sa.URL:
    try:
        url = sa.make_url(text)
    except sa.exc.ArgumentError:
        raise InputError(
            f"{URL} is not the URL of a database, such as postgresql://user@host/name"
        ) from None
    if url.drivername not in SERVERS:
        raise InputError(f"{URL} begins with {url.drivername}://; it must be postgresql://")
    return url.set(drivername="postgresql+psycopg")
