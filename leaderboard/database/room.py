"""A full disk, recognised in the many errors by which it shows itself."""

import shutil
import tempfile
from pathlib import Path
from typing import Final

import sqlalchemy as sa
from colift.agents.submissions.folder import FULL, MIB
from colift.base.errors import EvaluatorFault

LEAST: Final = MIB // 4
"""Free space below which SQLite cannot open a database beside its file [bytes]: it needs a few
pages, and reports their lack only as an error of input or output."""

MEMORY: Final = Path("/dev/shm")
"""A folder in memory, for a copy if all disks are full."""


class NoRoomError(EvaluatorFault):
    """A disk is full."""

    def __init__(self, folder: Path) -> None:
        super().__init__(f"the disk of {folder} is full: free some space there, and try again")


def is_full(error: BaseException, folder: Path | None = None) -> bool:
    """Return whether an error comes from a full disk.

    Parameters
    ----------
    error
        The error.
    folder
        The folder that was written to, if it is known.
    """
    if isinstance(error, NoRoomError) or (isinstance(error, OSError) and error.errno in FULL):
        return True
    name = str(getattr(getattr(error, "orig", None), "sqlite_errorname", ""))
    if not isinstance(error, sa.exc.DBAPIError) or not name:
        return False
    vague = name.startswith(("SQLITE_IOERR", "SQLITE_CANTOPEN"))
    return name == "SQLITE_FULL" or (vague and folder is not None and _free(folder) < LEAST)


def folder_with_room(size: int) -> str:
    """Return a folder for temporary files of a size [bytes]: the usual one, or memory."""
    usual = tempfile.gettempdir()
    if _free(Path(usual)) < size + LEAST and MEMORY.is_dir() and _free(MEMORY) >= size + LEAST:
        return str(MEMORY)
    return usual


def _free(folder: Path) -> int:
    try:
        return shutil.disk_usage(folder).free
    except OSError:
        return 2**63
