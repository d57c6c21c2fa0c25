"""Files that commands write to."""

import os
from pathlib import Path

from ..agents.errors import InputError


def check_output(path: Path | None) -> None:
    """Refuse a file that cannot be written, before any work is done.

    Raises
    ------
    InputError
        If its folder is missing or not writable, or it is itself a folder.
    """
    if path is None:
        return
    if not path.parent.is_dir():
        raise InputError(f"cannot write {path}: there is no folder {path.parent}")
    if path.is_dir() or not os.access(path if path.exists() else path.parent, os.W_OK):
        raise InputError(f"cannot write {path}: it is a folder, or not writable")
