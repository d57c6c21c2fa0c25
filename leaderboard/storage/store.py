"""The files of a board, beside its database.

::

    board.json                               format, and kind of database
    submissions/DIGEST/                      submitted files, by digest
    public/SEASON/entries/DIGEST/bundle/     the bundle of the public run
    public/SEASON/entries/DIGEST/bundle.zip  the same in one file, made at the first request
    logs/JOB.txt                             the workers' log of a job
    private/SEASON/                          the secret, results of two people, faults in detail
    private/work/                            evaluations in progress
    private/ranking                          held while ranks are computed

Only ``public`` may be shown to everyone, and a log to those who know the id of its job.
"""

import os
import re
import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from colift.agents.submissions.new import check_author
from colift.agents.submissions.submission import Submission, copy_submission, read_submission
from colift.base.errors import InputError
from colift.leaderboard.storage.archive import pack_archive
from colift.leaderboard.storage.files import read_json, sync, sync_tree, write_json
from colift.leaderboard.storage.season_secrets import FOLDER, PRIVATE_FILE, SeasonSecrets
from colift.leaderboard.storage.staging import Incoming, staging

if sys.platform != "win32":
    import fcntl

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
"""Names in the folder of a new board; an existing one may hold other files, too."""

LOG_BYTES: Final = 100_000
"""Maximum length of the shown end of a log [bytes]."""

_FOLDERS: Final = re.compile(r"(?<![\w/.:])/(?:[^\s/'\"<>:,]+/)+")
"""Pattern of the folders of an absolute path, but not of a URL or a quotient."""


def has_board(folder: Path) -> bool:
    """Return whether a folder is that of a board."""
    return (folder / "board.json").is_file()


@dataclass(frozen=True)
class Store:
    """A board's folder."""

    folder: Path

    def prepare(self, database: str) -> None:
        """Make the folder.

        Parameters
        ----------
        database
            Place of the tables: ``SQLite`` in this folder, or ``PostgreSQL``.

        Raises
        ------
        InputError
            If the folder has other content, or its tables are elsewhere.
        OSError
            If it cannot be written to.
        """
        if self.folder.is_dir() and not has_board(self.folder):
            others = sorted({path.name for path in self.folder.iterdir()} - set(PARTS))
            if others:
                raise InputError(
                    f"{self.folder} is not a board: it holds {others[0]}; name a new folder"
                )
        self.folder.mkdir(parents=True, exist_ok=True)
        for name in ("private", "submissions", "logs"):
            (self.folder / name).mkdir(mode=FOLDER, exist_ok=True)
        (self.folder / "public").mkdir(exist_ok=True)
        with self.alone():
            self._mark(database)

    def _mark(self, database: str) -> None:
        """Record the kind of database, or check it."""
        mark = self.folder / "board.json"
        if not mark.exists():
            write_json(mark, {"format": FORMAT, "database": database})
        self.check(database)

    def check(self, database: str) -> None:
        """Refuse another layout, and a database that is not the board's; as :meth:`prepare`."""
        mark = self.folder / "board.json"
        try:
            content = read_json(mark)
        except ValueError as error:
            raise InputError(f"{mark} cannot be read: {error}") from error
        if content.get("format") != FORMAT:
            raise InputError(f"{mark}: format must be {FORMAT}, is {content.get('format')!r}")
        if content.get("database") != database:
            change = "set" if database == "SQLite" else "unset"
            raise InputError(
                f"{self.folder} has its tables in {content.get('database')}, not in {database}: "
                f"{change} COLIFT_DATABASE_URL"
            )

    @contextmanager
    def alone(self) -> Iterator[None]:
        """Hold the board's lock, which is released when this process ends for any reason."""
        with (self.folder / "lock").open("a") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            yield

    @contextmanager
    def ranking(self) -> Iterator[None]:
        """Hold the lock of those who compute ranks; readers never wait for it.

        A folder that cannot be written to has no lock.
        """
        try:
            path = self.folder / "private" / "ranking"
            file = os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT, PRIVATE_FILE), "wb")
        except OSError:
            yield
            return
        with file:
            fcntl.flock(file, fcntl.LOCK_EX)
            yield

    def secrets(self, season: str) -> SeasonSecrets:
        """Return the private files of a season."""
        return SeasonSecrets(folder=self.folder / "private" / season)

    def keep(self, folder: Path) -> Submission:
        """Copy a submission into the board, under its digest; a damaged copy there is replaced.

        Raises
        ------
        InputError
            If the submission is malformed.
        """
        with self.staging() as place:
            made = place / "submission"
            made.mkdir()
            return self._incoming(copy_submission(folder, made)).place()

    @contextmanager
    def staging(self) -> Iterator[Path]:
        """Yield a folder for files on their way to the submissions; see :func:`.staging`."""
        with staging(self.folder / "submissions") as place:
            yield place

    def incoming(self, files: Path) -> Incoming:
        """Return the submission in a folder of :meth:`staging`, ready to be placed.

        Raises
        ------
        InputError
            If the submission is malformed, or still has the author of the template.
        """
        return self._incoming(read_submission(files))

    def _incoming(self, submission: Submission) -> Incoming:
        check_author(submission.manifest)
        target = self.folder / "submissions" / submission.contents.digest
        return Incoming.of(submission, target)

    def submission(self, digest: str) -> Submission:
        """Return a submission that was kept.

        Raises
        ------
        InputError
            If it is missing, or has been changed.
        """
        place = self.folder / "submissions" / digest
        message = f"submission {digest} is not as it was submitted: submit the same files again"
        try:
            kept = read_submission(place)
        except InputError as error:
            raise InputError(message) from error
        if kept.contents.digest != digest:
            raise InputError(message)
        return kept

    def bundle(self, season: str, digest: str) -> Path:
        """Return the path of the bundle of a submission's public run, which may not exist yet."""
        return self.folder / "public" / season / "entries" / digest / "bundle"

    def place_bundle(self, season: str, digest: str, made: Path) -> None:
        """Move a bundle to its place, over the remains of an earlier attempt."""
        place = self.bundle(season, digest)
        shutil.rmtree(place, ignore_errors=True)
        for made_of_it in ("bundle.zip", "replays.json"):
            place.with_name(made_of_it).unlink(missing_ok=True)
        place.parent.mkdir(parents=True, exist_ok=True)
        sync_tree(made)
        made.rename(place)
        for folder in place.parents[:4]:  # As far as they may be new: to the board's.
            sync(folder)

    def packed_bundle(self, season: str, digest: str) -> Path | None:
        """Return the zip archive of a bundle; make it if needed; None without a bundle."""
        folder = self.bundle(season, digest)
        packed = folder.with_name("bundle.zip")
        if packed.is_file():
            return packed
        if not folder.is_dir():
            return None
        with self.staging() as place:
            made = place / packed.name
            with made.open("wb") as file:
                pack_archive(folder, file)
            sync(made)
            made.rename(packed)
        return packed

    @contextmanager
    def workspace(self, job: str, attempt: int) -> Iterator[Path]:
        """Yield an empty private folder for an attempt; remove those of earlier ones."""
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

    def placeless(self, text: str) -> str:
        """Return a text for publication: files by their names, without this machine's folders."""
        return _FOLDERS.sub("", text.replace(f"{self.folder}/", "/-/"))

    def add_to_log(self, job: str, text: str) -> None:
        """Append lines to a job's log."""
        with self._log(job).open("ab") as file:
            file.write(f"{text.rstrip()}\n".encode(errors="replace"))

    def add_to_private_log(self, season: str, job: str, text: str) -> None:
        """Append to the log that only the maintainer may read, since it may reveal hidden lifts."""
        folder = self.secrets(season).folder / "logs"
        folder.mkdir(mode=FOLDER, exist_ok=True)
        path = folder / f"{job}.txt"
        path.touch(mode=PRIVATE_FILE)
        with path.open("ab") as file:
            file.write(f"{text.rstrip()}\n".encode(errors="replace"))

    def _log(self, job: str) -> Path:
        return self.folder / "logs" / f"{job}.txt"
