"""Backup of a board in one file, written while the board is in use.

The file is a gzipped tar archive of ``backup.json``, the tables as ``board.sqlite`` (whichever
database the board uses) and the files that the tables refer to, in the layout of :mod:`.store`.
"""

import io
import json
import os
import tarfile
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import IO, Final

import sqlalchemy as sa
from colift.base.errors import InputError
from colift.leaderboard.core.board import BUILTIN, Board
from colift.leaderboard.database.connection import FILE, Database
from colift.leaderboard.database.queries import copy_tables, read_entries, read_seasons
from colift.leaderboard.database.room import NoRoomError, is_full
from colift.leaderboard.database.schema import jobs
from colift.leaderboard.storage.files import sync
from colift.leaderboard.storage.season_secrets import PRIVATE_FILE
from colift.leaderboard.storage.store import FORMAT as LAYOUT
from colift.leaderboard.storage.store import Store

MARK: Final = "backup.json"
"""The first member of the archive: its description."""

FORMAT: Final = 1
"""Version of the archive."""


@dataclass(frozen=True, kw_only=True)
class Backup:
    """The contents of a backup."""

    seasons: int
    entries: int
    jobs: int
    missing: tuple[str, ...]
    """Contents that the board lacked."""


@dataclass(frozen=True, kw_only=True)
class BackupContents:
    """The files to which the tables of a board refer."""

    seasons: dict[str, str]
    """The commitments, by name."""
    entries: tuple[tuple[str, str, bool], ...]
    """Season, digest, and whether the entry has a row."""
    submissions: frozenset[str]
    jobs: tuple[str, ...]

    @classmethod
    def of(cls, connection: sa.Connection) -> "BackupContents":
        """Return the references in the tables."""
        found = read_entries(connection)
        own = sa.select(jobs.c.id, jobs.c.submission, jobs.c.submitter)
        queued = connection.execute(own).all()
        return cls(
            seasons={each.name: each.commitment for each in read_seasons(connection)},
            entries=tuple((each.season, each.submission, each.row is not None) for each in found),
            submissions=frozenset(each.submission for each in queued if each.submitter != BUILTIN),
            jobs=tuple(each.id for each in queued),
        )

    def summary(self, missing: list[str]) -> Backup:
        """Return the counts of a backup."""
        return Backup(
            seasons=len(self.seasons),
            entries=len(self.entries),
            jobs=len(self.jobs),
            missing=tuple(missing),
        )

    def places(self) -> Iterator[tuple[str, str]]:
        """Yield the paths that a board may have, each with its name in words if it must exist."""
        for season in self.seasons:
            yield f"private/{season}/secret", f"the secret of season {season}"
            yield f"private/{season}/human_human.json", ""
            yield f"private/{season}/references.json", ""
            yield f"private/{season}/logs", ""
        for season, digest, row in self.entries:
            needed = f"the bundle of {digest} in season {season}" if row else ""
            yield f"public/{season}/entries/{digest}/bundle", needed
        for digest in sorted(self.submissions):
            yield f"submissions/{digest}", f"submission {digest}"
        for job in self.jobs:
            yield f"logs/{job}.txt", ""


@contextmanager
def opened_tables(folder: Path) -> Iterator[Database]:
    """Open the tables in a folder, an SQLite file."""
    database = Database.open(folder)
    try:
        yield database
    finally:
        database.close()


def back_up(board: Board, file: Path) -> Backup:
    """Write a board into a file that only its owner may read; service and workers may go on.

    The tables are copied first, as they are at one moment; all files that they refer to are there
    by then, and stay.

    Raises
    ------
    NoRoomError
        If the disk of the file is full.
    InputError
        If the file is there already, or cannot be written.
    """
    if file.exists():
        raise InputError(f"{file} is there already; name a new file")
    try:
        with tempfile.TemporaryDirectory(dir=file.absolute().parent, prefix=".backup-") as work:
            tables, made = Path(work), Path(work, "made")
            with board.database.reading() as source, opened_tables(tables) as copy:
                with copy.writing() as target:
                    copy_tables(source, target)
                with copy.reading() as connection:
                    wanted = BackupContents.of(connection)
            with os.fdopen(
                os.open(made, os.O_WRONLY | os.O_CREAT, PRIVATE_FILE), "wb"
            ) as target_file:
                missing = _write(board.store, tables / FILE, wanted, target_file)
            sync(made)
            made.rename(file)
            sync(file.absolute().parent)
    except (OSError, NoRoomError, sa.exc.DBAPIError) as error:
        if is_full(error):
            raise NoRoomError(file.absolute().parent) from error
        if not isinstance(error, OSError):
            raise
        raise InputError(f"cannot write {file}: {error.strerror or error}") from error
    return wanted.summary(missing)


def _write(store: Store, tables: Path, wanted: BackupContents, file: IO[bytes]) -> list[str]:
    """Write the archive; return what is missing on the board."""
    missing = []
    with tarfile.open(fileobj=file, mode="w:gz", compresslevel=1) as archive:
        mark = {"format": FORMAT, "board": LAYOUT, "colift": version("colift")}
        _add(archive, MARK, io.BytesIO(json.dumps(mark).encode()))
        with tables.open("rb") as source:
            _add(archive, FILE, source)
        for place, needed in wanted.places():
            found = sorted(_files(store.folder / place))
            try:
                for path in found:
                    with path.open("rb") as source:
                        _add(archive, path.relative_to(store.folder).as_posix(), source)
            except FileNotFoundError:
                found = []  # It gives way to another one in this moment.
            if needed and not found:
                missing.append(needed)
    return missing


def _files(place: Path) -> Iterator[Path]:
    if place.is_file():
        yield place
    elif place.is_dir():
        yield from (path for path in place.rglob("*") if path.is_file())


def _add(archive: tarfile.TarFile, name: str, source: IO[bytes]) -> None:
    entry = tarfile.TarInfo(name)
    entry.size, entry.mode = source.seek(0, os.SEEK_END), PRIVATE_FILE
    source.seek(0)  # Lines that are added to a log meanwhile are not part of it.
    archive.addfile(entry, source)
