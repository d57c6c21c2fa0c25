"""What a board keeps to itself: a season's secret, and what would give hidden episodes away."""

import os
import stat
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from ..agents.errors import InputError
from ..benchmark.hidden import SECRET_BYTES, new_secret
from ..benchmark.references import Reference
from .files import read_json, write_json

OWN: Final = 0o600
"""A file that only its owner may read."""

FOLDER: Final = 0o700
"""A folder that only its owner may enter."""


@dataclass(frozen=True, kw_only=True)
class Vault:
    """The private files of a season; nothing of them is published."""

    folder: Path

    def secret(self) -> bytes:
        """Return the season's secret; it is made when it is asked for first.

        Raises
        ------
        InputError
            If others may read it, or it is no secret of ours.
        """
        path = self.folder / "secret"
        if not path.exists():
            self.folder.mkdir(mode=FOLDER, parents=True, exist_ok=True)
            handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, OWN)
            with os.fdopen(handle, "w") as file:
                file.write(f"{new_secret().hex()}\n")
                file.flush()
                os.fsync(file.fileno())
        mode = stat.S_IMODE(path.stat().st_mode)
        if mode & 0o077:
            raise InputError(f"{path} has mode {mode:o}, others may read it; it must be {OWN:o}")
        try:
            secret = bytes.fromhex(path.read_text())
        except ValueError:
            secret = b""
        if len(secret) != SECRET_BYTES:
            raise InputError(f"{path} must hold {2 * SECRET_BYTES} hexadecimal digits")
        return secret

    def team(self, play: Callable[[], Reference]) -> Reference:
        """Return the human-human team on the hidden episodes; it is played only once."""
        path = self.folder / "team.json"
        if not path.exists():
            write_json(path, play().plain(), mode=OWN)
        return Reference.read(read_json(path))

    @property
    def has_team(self) -> bool:
        """Whether :meth:`team` need not play."""
        return (self.folder / "team.json").exists()

    def keep_errors(self, submission: str, rmse_mm: tuple[float, ...]) -> None:
        """Keep a submission's RMSE in each hidden episode [mm]."""
        write_json(self._errors(submission), {"rmse_mm": list(rmse_mm)}, mode=OWN)

    def errors(self, submission: str) -> tuple[float, ...]:
        """Return what :meth:`keep_errors` has kept."""
        return tuple(read_json(self._errors(submission))["rmse_mm"])

    def _errors(self, submission: str) -> Path:
        folder = self.folder / "errors"
        folder.mkdir(mode=FOLDER, exist_ok=True)
        return folder / f"{submission}.json"
