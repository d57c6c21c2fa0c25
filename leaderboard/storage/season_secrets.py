"""Private files of a season: its secret, and data about the hidden episodes."""

import os
import stat
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from colift.base.errors import InputError, error_text
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.hidden import SECRET_BYTES
from colift.leaderboard.storage.damage import DAMAGE, DamagedError
from colift.leaderboard.storage.files import read_json, sync, write_json

PRIVATE_FILE: Final = 0o600
"""Mode of a file that only its owner may read."""

FOLDER: Final = 0o700
"""Mode of a folder that only its owner may enter."""


@dataclass(frozen=True, kw_only=True)
class SeasonSecrets:
    """The private files of a season; none is published."""

    folder: Path

    def keep_secret(self, secret: bytes) -> None:
        """Write the season's secret, before anything is derived from it.

        Raises
        ------
        FileExistsError
            If there is one.
        """
        self.folder.mkdir(mode=FOLDER, parents=True, exist_ok=True)
        handle = os.open(self._secret, os.O_WRONLY | os.O_CREAT | os.O_EXCL, PRIVATE_FILE)
        with os.fdopen(handle, "w") as file:
            file.write(f"{secret.hex()}\n")
            file.flush()
            os.fsync(file.fileno())
        sync(self.folder)
        sync(self.folder.parent)

    def forget_secret(self) -> None:
        """Remove a secret whose season did not begin."""
        self._secret.unlink(missing_ok=True)

    def secret(self) -> bytes:
        """Return the season's secret.

        Raises
        ------
        InputError
            If there is none, others may read it, or it is malformed.
        """
        path = self._secret
        if not path.exists():
            raise InputError(f"{path} is missing: is this the folder of the database's board?")
        mode = stat.S_IMODE(path.stat().st_mode)
        if mode & 0o077:
            raise InputError(
                f"{path} has mode {mode:o}, others may read it; it must be {PRIVATE_FILE:o}"
            )
        try:
            secret = bytes.fromhex(path.read_text())
        except ValueError:
            secret = b""
        if len(secret) != SECRET_BYTES:
            raise InputError(f"{path} must hold {2 * SECRET_BYTES} hexadecimal digits")
        return secret

    def human_human(self, play: Callable[[], ScoreTable]) -> ScoreTable:
        """Return the results of two people on the hidden episodes; they are played only once."""
        known = self.known_human_human()
        if known is None:
            known = play()
            self.keep_human_human(known)
        return known

    def known_human_human(self) -> ScoreTable | None:
        """Return the baseline that :meth:`human_human` has stored, or None if it has not run.

        Raises
        ------
        DamagedError
            If its file is damaged.
        """
        path = self.folder / "human_human.json"
        with _undamaged(path, "the next evaluation plays two people again"):
            return ScoreTable.read(read_json(path)) if path.exists() else None

    def keep_human_human(self, human_human: ScoreTable) -> None:
        """Write the results of two people."""
        self.folder.mkdir(mode=FOLDER, parents=True, exist_ok=True)
        write_json(self.folder / "human_human.json", human_human.plain(), mode=PRIVATE_FILE)

    def known_references(self) -> dict[str, ScoreTable]:
        """Return the references on the hidden episodes, by name; none until they are played.

        Raises
        ------
        DamagedError
            If their file is damaged.
        """
        path = self.folder / "references.json"
        with _undamaged(path, "'colift season references' plays them again"):
            found = read_json(path) if path.exists() else {}
            return {name: ScoreTable.read(each) for name, each in found.items()}

    def keep_references(self, references: Mapping[str, ScoreTable]) -> None:
        """Write the references."""
        self.folder.mkdir(mode=FOLDER, parents=True, exist_ok=True)
        content = {name: each.plain() for name, each in references.items()}
        write_json(self.folder / "references.json", content, mode=PRIVATE_FILE)

    @property
    def _secret(self) -> Path:
        return self.folder / "secret"


@contextmanager
def _undamaged(path: Path, again: str) -> Iterator[None]:
    """Turn an error in a file into one that says how to replace it."""
    try:
        yield
    except DAMAGE as error:
        raise DamagedError(
            f"{path} is damaged ({error_text(error)}): restore it from a backup, or remove it, "
            f"and {again}"
        ) from error
