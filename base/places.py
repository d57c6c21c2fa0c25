"""Places of results, tried before any work is done."""

import tempfile
from pathlib import Path

from colift.base.errors import InputError


def check_beside(path: Path) -> None:
    """Make the folders above a place, or refuse it.

    Raises
    ------
    InputError
        If they cannot be made, or nothing can be written beside the place.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=path.parent):
            pass
    except OSError as error:
        raise InputError(f"cannot write to {path.parent}: {error.strerror}") from error


def check_empty(folder: Path) -> None:
    """Refuse a place that is neither free nor an empty folder.

    Raises
    ------
    InputError
        If something is there, or the folder cannot be read.
    """
    try:
        if folder.is_symlink() or (folder.exists() and not folder.is_dir()):
            raise InputError(f"{folder} is there already; name a new folder")
        if folder.exists() and any(folder.iterdir()):
            raise InputError(f"{folder} is not empty; name a new folder")
    except OSError as error:
        raise InputError(f"cannot read {folder}: {error.strerror}") from error
