"""The files of a board, beside its database.

::

    board.json                               that it is a board, and where its database is
    submissions/DIGEST/                      what was submitted, by its content
    public/SEASON/entries/DIGEST/bundle/     the bundle of the public run
    logs/JOB.txt                             what the workers wrote of a job
    private/SEASON/                          the secret, the human-human team, faults in detail
    private/work/                            what is being evaluated

Only ``public`` may be shown to anybody, and ``logs`` to who submitted it.
"""

import contextlib
import fcntl
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from ..agents.errors import InputError
from ..agents.submissions.folder import copy_folder
from ..agents.submissions.submission import Submission, read_submission
from .files import read_json, write_json
from .vault import FOLDER, OWN, Vault

FORMAT: Final = 2
"""Version of the layout."""

PARTS: Final = (
    "board.json",
    "board.sqlite",
    "board.sqlite-shm",
    "board.sqlite-wal",
    "lock",
    "logs",
    "private",
    "public",
    "submissions",
)
"""What is in a board."""

LOG_BYTES: Final = 100_000
"""So much of a log's end is shown."""


@dataclass(frozen=True)
class Store:
    """A board's folder."""

    folder: Path

    def prepare(self, database: str) -> None:
        """Make the folder.

        Parameters
        ----------
        database
            Where the tables are: ``SQLite`` in this folder, or ``PostgreSQL``.

        Raises
        ------
        InputError
            If something else is there, or its tables are elsewhere.
        OSError
            If it cannot be written.
        """
        if self.folder.is_dir():
            others = sorted({path.name for path in self.folder.iterdir()} - set(PARTS))
            if others:
                raise InputError(
                    f"{self.folder} is no board: it holds {others[0]}; name a new folder"
                )
        self.folder.mkdir(parents=True, exist_ok=True)
        for name in ("private", "submissions", "logs"):
            (self.folder / name).mkdir(mode=FOLDER, exist_ok=True)
        (self.folder / "public").mkdir(exist_ok=True)
        with self.alone():
            self._mark(database)

    def _mark(self, database: str) -> None:
        """Write down where the tables are, or check that they are there."""
        mark = self.folder / "board.json"
        if not mark.exists():
            write_json(mark, {"format": FORMAT, "database": database})
            return
        try:
            told = read_json(mark)
        except ValueError as error:
            raise InputError(f"{mark} cannot be read: {error}") from error
        if told.get("format") != FORMAT:
            raise InputError(f"{mark}: format must be {FORMAT}, is {told.get('format')!r}")
        if told.get("database") != database:
            change = "set" if database == "SQLite" else "unset"
            raise InputError(
                f"{self.folder} has its tables in {told.get('database')}, not in {database}: "
                f"{change} COLIFT_DATABASE_URL"
            )

    @contextmanager
    def alone(self) -> Iterator[None]:
        """Hold the board's lock; it ends with this process, however that ends."""
        with (self.folder / "lock").open("a") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            yield

    def vault(self, season: str) -> Vault:
        """Return the private files of a season."""
        return Vault(folder=self.folder / "private" / season)

    def keep(self, folder: Path) -> Submission:
        """Copy a submission into the board, under its digest; what is there is left as it is.

        Raises
        ------
        InputError
            If it is not what a submission must be.
        """
        store = self.folder / "submissions"
        with tempfile.TemporaryDirectory(dir=store, prefix=".new-") as temporary:
            made = Path(temporary) / "submission"
            made.mkdir()
            digest = copy_folder(folder, made).digest
            read_submission(made)
            with contextlib.suppress(OSError):  # It has been submitted before.
                made.rename(store / digest)
        return self.submission(digest)

    def submission(self, digest: str) -> Submission:
        """Return a submission that was kept.

        Raises
        ------
        InputError
            If it is not there, or has been changed.
        """
        place = self.folder / "submissions" / digest
        kept = read_submission(place)
        if kept.contents.digest != digest:
            raise InputError(f"{place} has been changed; move it away and submit again")
        return kept

    def bundle(self, season: str, digest: str) -> Path:
        """Return where the bundle of a submission's public run is, or will be."""
        return self.folder / "public" / season / "entries" / digest / "bundle"

    def place_bundle(self, season: str, digest: str, made: Path) -> None:
        """Move a bundle to its place; what an attempt that was killed has left there gives way."""
        place = self.bundle(season, digest)
        shutil.rmtree(place, ignore_errors=True)
        place.parent.mkdir(parents=True, exist_ok=True)
        made.rename(place)

    @contextmanager
    def workspace(self, job: str, attempt: int) -> Iterator[Path]:
        """Yield an empty private folder for an attempt; what earlier ones have left is removed."""
        work = self.folder / "private" / "work"
        work.mkdir(mode=FOLDER, exist_ok=True)
        for old in work.glob(f"{job}-*"):
            shutil.rmtree(old, ignore_errors=True)
        files = work / f"{job}-{attempt}"
        files.mkdir(mode=FOLDER)
        try:
            yield files
        finally:
            shutil.rmtree(files, ignore_errors=True)

    def log(self, job: str) -> str | None:
        """Return the end of a job's log, or None if there is none."""
        try:
            with self._log(job).open("rb") as file:
                file.seek(0, 2)
                file.seek(max(0, file.tell() - LOG_BYTES))
                return file.read().decode(errors="replace")
        except FileNotFoundError:
            return None

    def add_to_log(self, job: str, text: str) -> None:
        """Append lines to a job's log."""
        with self._log(job).open("ab") as file:
            file.write(f"{text.rstrip()}\n".encode(errors="replace"))

    def add_to_private_log(self, season: str, job: str, text: str) -> None:
        """Append to what only the board's keeper may read of a job: it may tell of hidden lifts."""
        folder = self.vault(season).folder / "logs"
        folder.mkdir(mode=FOLDER, exist_ok=True)
        path = folder / f"{job}.txt"
        path.touch(mode=OWN)
        with path.open("ab") as file:
            file.write(f"{text.rstrip()}\n".encode(errors="replace"))

    def _log(self, job: str) -> Path:
        return self.folder / "logs" / f"{job}.txt"
