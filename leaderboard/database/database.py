"""The connection to a board's database: its own SQLite file, or a PostgreSQL server."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Self

import sqlalchemy as sa

from ...agents.errors import InputError
from .migration import upgrade
from .transactions import make_engine, reading, writing

URL: Final = "COLIFT_DATABASE_URL"
"""Environment variable that names another database than the file in the board's folder."""

FILE: Final = "board.sqlite"
"""That file."""

SERVERS: Final = ("postgresql", "postgres", "postgresql+psycopg")
"""What may stand before ``://`` in the variable."""


@dataclass(frozen=True)
class Database:
    """An open database whose tables are as this colift needs them."""

    engine: sa.Engine

    @classmethod
    def open(cls, folder: Path, url: str | None = None) -> Self:
        """Return the database of the board in a folder; its tables are made or brought up to date.

        Parameters
        ----------
        folder
            The board's folder.
        url
            Another database; None is the file in the folder.

        Raises
        ------
        InputError
            If there is no such database, it does not answer, or is of a later colift.
        """
        place = _url(url) if url else sa.URL.create("sqlite", database=str(folder / FILE))
        shown = place.render_as_string(hide_password=True)
        if place.get_backend_name() == "sqlite":
            (folder / FILE).touch(mode=0o600)  # It holds hidden scores.
        try:
            engine = make_engine(place)
        except ImportError:
            raise InputError(f"{shown} needs psycopg: pip install 'colift[board]'") from None
        try:
            upgrade(engine, shown)
        except sa.exc.DBAPIError as error:
            engine.dispose()
            raise InputError(f"database {shown} cannot be opened: {error.orig}") from error
        except InputError:
            engine.dispose()
            raise
        return cls(engine)

    @contextmanager
    def reading(self) -> Iterator[sa.Connection]:
        """Yield a connection that sees one state of the database."""
        with reading(self.engine) as connection:
            yield connection

    @contextmanager
    def writing(self) -> Iterator[sa.Connection]:
        """Yield a connection whose changes are made as a whole, or not at all.

        There is one writer at a time, as SQLite has it: so what it has read stays true.
        """
        with writing(self.engine) as connection:
            yield connection

    def close(self) -> None:
        """Close all connections."""
        self.engine.dispose()


def _url(text: str) -> sa.URL:
    try:
        url = sa.make_url(text)
    except sa.exc.ArgumentError:
        raise InputError(f"{URL} is no URL of a database: postgresql://user@host/name") from None
    if url.drivername not in SERVERS:
        raise InputError(f"{URL} begins with {url.drivername}://; it must be postgresql://")
    return url.set(drivername="postgresql+psycopg")
