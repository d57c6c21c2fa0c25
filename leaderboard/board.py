"""A board as a folder.

::

    board.json                         which season it is
    submissions/DIGEST/                what was submitted, by its content
    private/SEASON/                    the secret, and what would give hidden episodes away
    public/SEASON/season.json          name, suite, commitment
    public/SEASON/entries/DIGEST/      entry.json, and the bundle of the public run

Only ``public`` may be shown to anybody. Entries are written once and never changed.
"""

import contextlib
import fcntl
import re
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, Self

from ..agents.errors import InputError
from ..agents.submissions.folder import copy_folder
from ..agents.submissions.submission import Submission, read_submission
from ..benchmark.statistics import rank_groups
from ..benchmark.suite import make_suite
from .entry import Entry
from .files import read_json, write_json
from .row import Row
from .season import Season
from .vault import FOLDER, Vault

FORMAT: Final = 1
"""Version of the layout."""

FIRST: Final = "1"
"""Name of a new board's season."""

SUITE: Final = "standard-v1"
"""What a new board evaluates on, if nothing else is said."""

PARTS: Final = ("board.json", "lock", "private", "public", "submissions")
"""What is in a board."""

NAME: Final = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,39}")
"""What a season may be called."""


@dataclass(frozen=True)
class Board:
    """A board that is there."""

    folder: Path

    @classmethod
    def open(cls, folder: Path, suite: str | None = None) -> Self:
        """Return the board in a folder; it is made if there is none.

        Parameters
        ----------
        folder
            Where it is; or where it shall be, a new or empty folder.
        suite
            Name of the suite that it must have; None takes any, and ``standard-v1`` for a new one.

        Raises
        ------
        InputError
            If something else is there, it cannot be written, or it has another suite.
        """
        board = cls(folder.absolute())
        try:
            if folder.is_dir():
                others = sorted({path.name for path in folder.iterdir()} - set(PARTS))
                if others:
                    raise InputError(
                        f"{folder} is no board: it holds {others[0]}; name a new folder"
                    )
            folder.mkdir(parents=True, exist_ok=True)
            with board._alone("lock"):
                if not board._file.exists():
                    board._begin(FIRST, suite or SUITE)
        except OSError as error:
            raise InputError(f"cannot use {folder} as a board: {error.strerror}") from error
        season = board.season
        if suite not in (None, season.suite.name):
            raise InputError(f"{folder} is a board of {season.suite.name}, not of {suite}")
        return board

    @property
    def season(self) -> Season:
        """The season that submissions are evaluated in now.

        Raises
        ------
        InputError
            If the board was made by a colift of other rules, or its files were changed.
        """
        content = self._read(self._file)
        if content.get("format") != FORMAT:
            raise InputError(f"{self._file}: format must be {FORMAT}, is {content.get('format')!r}")
        name = str(content["season"])
        told = self._read(self._public(name) / "season.json")
        suite = make_suite(told["suite"])
        if suite.digest != told["suite_digest"]:
            raise InputError(
                f"season {name} of {self.folder} is on {suite.name} of digest "
                f"{told['suite_digest']}, this colift plays {suite.digest}: begin a new season"
            )
        season = Season(name=name, suite=suite, secret=self.vault(name).secret())
        if season.commitment != told["commitment"]:
            raise InputError(f"the secret of season {name} is not the one that was committed to")
        return season

    def new_season(self, name: str, suite: str | None = None) -> Season:
        """Begin a season, with a new secret; the rows so far stay, in their own table.

        Parameters
        ----------
        name
            What it is called.
        suite
            Name of its suite; by default as so far.

        Raises
        ------
        InputError
            If there has been a season of that name, or it is no name.
        """
        if not NAME.fullmatch(name):
            raise InputError(f"season {name!r} must be letters, digits, - and _, at most 40")
        with self._alone("lock"):
            if name in self.seasons():
                raise InputError(f"{self.folder} has had a season {name}")
            current = self._read(self._file)["season"]
            self._begin(name, suite or self._read(self._public(current) / "season.json")["suite"])
        return self.season

    def seasons(self) -> tuple[str, ...]:
        """Return the names of all seasons that have begun."""
        return tuple(sorted(path.parent.name for path in self._public("").glob("*/season.json")))

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
            place = store / digest
            with contextlib.suppress(OSError):  # It has been submitted before.
                made.rename(place)
        kept = read_submission(place)
        if kept.contents.digest != digest:
            raise InputError(f"{place} has been changed; move it away and submit again")
        return kept

    def entry(self, season: str, digest: str) -> Entry | None:
        """Return what the board says of a submission, or None if it has not been evaluated."""
        path = self._entry(season, digest) / "entry.json"
        return Entry.read(self._read(path)) if path.exists() else None

    def bundle(self, season: str, digest: str) -> Path:
        """Return where the bundle of a submission's public run is."""
        return self._entry(season, digest) / "bundle"

    @contextmanager
    def evaluating(self, digest: str) -> Iterator[Path]:
        """Hold a submission for evaluation; yield an empty folder for its files.

        What a process that was killed has left of it is removed.

        Raises
        ------
        InputError
            If another process holds it.
        """
        work = self.folder / "private" / "work"
        work.mkdir(mode=FOLDER, exist_ok=True)
        with self._alone(f"private/work/{digest}.lock", wait=False):
            files = work / digest
            shutil.rmtree(files, ignore_errors=True)
            files.mkdir()
            try:
                yield files
            finally:
                shutil.rmtree(files, ignore_errors=True)

    def record(self, season: str, entry: Entry, files: Path) -> None:
        """Add an entry, with the files of its evaluation; it is there as a whole or not at all."""
        write_json(files / "entry.json", entry.plain())
        place = self._entry(season, entry.submission)
        place.parent.mkdir(exist_ok=True)
        files.rename(place)

    def rows(self, season: str) -> list[Row]:
        """Return the rows of a season, in the order of their hidden RMSE."""
        found = self._public(season).glob("entries/*/entry.json")
        entries = [Entry.read(self._read(path)) for path in found]
        rows = [entry.row for entry in entries if entry.row is not None]
        return sorted(rows, key=lambda row: (row.hidden.rmse_mm.mean, row.submission))

    def ranking(self, season: str) -> list[tuple[int, Row]]:
        """Return the rank group of each row, 1 the best, in that order; see :func:`.rank_groups`.

        Ranks follow from the hidden episodes, lift by lift.
        """
        rows = {row.submission: row for row in self.rows(season)}
        vault = self.vault(season)
        groups = rank_groups({digest: vault.errors(digest) for digest in rows})
        return [(rank, rows[digest]) for rank, group in enumerate(groups, 1) for digest in group]

    @property
    def _file(self) -> Path:
        return self.folder / "board.json"

    def _public(self, season: str) -> Path:
        return self.folder / "public" / season

    def _entry(self, season: str, digest: str) -> Path:
        return self._public(season) / "entries" / digest

    def _begin(self, name: str, suite: str) -> None:
        made = make_suite(suite)
        (self.folder / "private").mkdir(mode=FOLDER, exist_ok=True)
        (self.folder / "submissions").mkdir(mode=FOLDER, exist_ok=True)
        season = Season(name=name, suite=made, secret=self.vault(name).secret())
        self._public(name).mkdir(parents=True, exist_ok=True)
        told = {
            "season": name,
            "suite": made.name,
            "suite_digest": made.digest,
            "commitment": season.commitment,
        }
        write_json(self._public(name) / "season.json", told)
        write_json(self._file, {"format": FORMAT, "season": name})

    def _read(self, path: Path) -> dict[str, Any]:
        try:
            return read_json(path)
        except (OSError, ValueError) as error:
            raise InputError(f"{path} cannot be read: {error}") from error

    @contextmanager
    def _alone(self, name: str, *, wait: bool = True) -> Iterator[None]:
        """Hold a lock of the board; it ends with this process, however that ends."""
        with (self.folder / name).open("a") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
            except BlockingIOError:
                raise InputError("this submission is being evaluated by another process") from None
            yield
