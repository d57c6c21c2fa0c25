"""Restoration of a board from a backup."""

import gzip
import json
import os
import re
import tarfile
import tempfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

import sqlalchemy as sa
from colift.base.errors import InputError
from colift.benchmark.suites.hidden import commitment
from colift.leaderboard.backup.checking import check_tables
from colift.leaderboard.backup.writing import FORMAT, MARK, Backup, BackupContents, opened_tables
from colift.leaderboard.database.connection import FILE, URL, Database
from colift.leaderboard.database.queries import copy_tables
from colift.leaderboard.database.schema import metadata, rank_groups
from colift.leaderboard.storage.damage import DamagedError
from colift.leaderboard.storage.files import sync, sync_tree, write_json
from colift.leaderboard.storage.season_secrets import FOLDER, PRIVATE_FILE
from colift.leaderboard.storage.store import FORMAT as LAYOUT
from colift.leaderboard.storage.store import Store

PRIVATE: Final = ("private", "submissions", "logs")
"""Folders of a board that only its owner may enter."""

_NAME: Final = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.+@-]*")


def restore(file: Path, folder: Path, url: str | None = None) -> Backup:
    """Make the board of a backup in a new folder.

    Parameters
    ----------
    file
        A backup by :func:`.back_up`.
    folder
        Destination: a folder that does not exist, or is empty.
    url
        An empty PostgreSQL database for the tables, instead of a file in the folder; by default
        that of the environment's ``COLIFT_DATABASE_URL``, if there is one.

    Raises
    ------
    InputError
        If the file is not a backup, is damaged or of another colift, or the folder or the database
        is not empty.
    """
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise InputError(f"{folder} is not empty; name a new folder for the board")
    url = url or os.environ.get(URL) or None
    place = folder.absolute()
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=place.parent, prefix=".restore-") as work:
            made = Path(work, "board")
            _unpack(file, made)
            with _intact(file, made), opened_tables(made) as tables:
                check_tables(tables)
                with tables.writing() as connection:
                    # They follow from the rest, and are not checked.
                    connection.execute(sa.delete(rank_groups))
                with tables.reading() as connection:
                    wanted = BackupContents.of(connection)
                missing = _check(Store(made), wanted)
            if url:
                with opened_tables(made) as tables, tables.reading() as connection:
                    _fill(made, url, connection)
            if url:
                (made / FILE).unlink()
            database = "PostgreSQL" if url else "SQLite"
            write_json(made / "board.json", {"format": LAYOUT, "database": database})
            sync_tree(made)
            if place.is_dir():
                place.rmdir()
            made.rename(place)
            sync(place.parent)
    except OSError as error:
        raise InputError(f"cannot restore {file} to {folder}: {error.strerror or error}") from error
    return wanted.summary(missing)


@contextmanager
def _intact(file: Path, made: Path) -> Iterator[None]:
    """Raise what is wrong with the content of a backup as an InputError that names the backup."""
    try:
        yield
    except (
        InputError,
        DamagedError,
        sa.exc.SQLAlchemyError,
        ValueError,
        TypeError,
        LookupError,
    ) as error:
        reason = str(error.orig if isinstance(error, sa.exc.DBAPIError) else error)
        shown = reason.replace(f"{made}/", "").replace(f"{made.name}/", "")
        raise InputError(f"{file} cannot be restored: {shown}") from error


def _unpack(file: Path, folder: Path) -> None:
    """Write the files of an archive into a new folder, with the modes that a board's have."""
    try:
        with gzip.open(file) as unpacked, tarfile.open(fileobj=unpacked, mode="r:") as archive:
            first = archive.next()
            content = first and first.name == MARK and archive.extractfile(first)
            mark = json.load(content) if content else {}
            if (mark.get("format"), mark.get("board")) != (FORMAT, LAYOUT):
                raise InputError(f"{file} is not a backup of a board, or one of another colift")
            folder.mkdir()
            for name in PRIVATE:
                (folder / name).mkdir(mode=FOLDER)
            (folder / "public").mkdir()
            while entry := archive.next():
                _extract(archive, entry, folder)
            while unpacked.read(2**20):
                pass  # The checksum of the archive is at its end.
    except (
        tarfile.TarError,
        gzip.BadGzipFile,
        zlib.error,
        EOFError,
        ValueError,
        AttributeError,
    ) as error:
        raise InputError(f"{file} is not a backup of a board, or is damaged: {error}") from error
    if not (folder / FILE).is_file():
        raise InputError(f"{file} is damaged: it holds no {FILE}")


def _extract(archive: tarfile.TarFile, entry: tarfile.TarInfo, folder: Path) -> None:
    parts = entry.name.split("/")
    known = parts == [FILE] or (len(parts) > 1 and parts[0] in (*PRIVATE, "public"))
    source = archive.extractfile(entry) if entry.isreg() else None
    if source is None or not known or not all(map(_NAME.fullmatch, parts)):
        raise InputError(f"{entry.name!a} is nothing that a backup of a board holds")
    private = parts[0] in ("private", FILE)
    place = folder / entry.name
    above = folder
    for name in parts[:-1]:
        above /= name
        above.mkdir(mode=FOLDER if private else 0o755, exist_ok=True)
    with source, place.open("xb") as target:
        os.fchmod(target.fileno(), PRIVATE_FILE if private else 0o644)
        while data := source.read(2**20):
            target.write(data)


def _check(store: Store, wanted: BackupContents) -> list[str]:
    """Return the missing or damaged contents; refuse a board with a missing or wrong secret."""
    for season, promised in wanted.seasons.items():
        secrets = store.secrets(season)
        if commitment(secrets.secret()) != promised:
            raise InputError(f"the secret of season {season} does not match its commitment")
        secrets.known_human_human()
        secrets.known_references()
    missing = []
    for place, needed in wanted.places():
        if needed and not (store.folder / place).exists():
            missing.append(needed)
    for digest in wanted.submissions:
        if (store.folder / "submissions" / digest).is_dir():
            try:
                store.submission(digest)
            except InputError:
                missing.append(f"submission {digest} as it was submitted")
    return missing


def _fill(folder: Path, url: str, source: sa.Connection) -> None:
    """Copy the tables into an empty database."""
    database = Database.open(folder, url)
    try:
        with database.writing() as target:
            for table in metadata.sorted_tables:
                if target.execute(sa.select(table).limit(1)).first() is not None:
                    raise InputError(f"the database of {URL} is not empty; name an empty one")
            copy_tables(source, target)
    finally:
        database.close()
