"""Private copies of submissions: later edits of a folder do not affect a run.

A copy is named by its digest and lies in the user's cache folder, so that equal submissions have
equal paths in every run, and a resumed run finds its copy.
"""

import os
import shutil
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Final

from colift.agents.submissions.folder import (
    LIMITS,
    FolderContents,
    copy_folder,
    read_folder,
    unwritable,
)
from colift.agents.submissions.line_ends import is_text, with_unix_line_ends
from colift.base.errors import InputError

KEPT_DAYS: Final = 7
"""Days that a copy is kept after its last use."""


def snapshot(folder: Path) -> tuple[Path, FolderContents]:
    """Return the private copy of a folder, and its files.

    Raises
    ------
    InputError
        As :func:`.folder.read_folder`, or if the cache folder cannot be written to.
    """
    return _stored(lambda target: copy_folder(folder, target))


def snapshot_file(path: Path) -> tuple[Path, FolderContents]:
    """Return a private folder with a copy of one file alone, and its content.

    Raises
    ------
    InputError
        If there is no such file, it is too large or its name is not allowed in a submission, or the
        cache folder cannot be written to.
    """
    if not path.is_file():
        raise InputError(f"no such file: {path}")
    if path.stat().st_size > LIMITS.file_bytes:
        raise InputError(f"{path} has more than {LIMITS.file_bytes} bytes")

    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from error

    def copy(target: Path) -> FolderContents:
        made = with_unix_line_ends(data) if is_text(path.name, len(data)) else data
        (target / path.name).write_bytes(made)
        return read_folder(target)

    return _stored(copy)


def _stored(copy: Callable[[Path], FolderContents]) -> tuple[Path, FolderContents]:
    """Return the folder that ``copy`` fills, named by its digest, and its files."""
    cache = _cache()
    try:
        with tempfile.TemporaryDirectory(dir=cache, prefix="new-") as made:
            fresh = Path(made) / "submission"
            fresh.mkdir()
            contents = copy(fresh)
            place = cache / contents.digest[:32]
            if not _holds(place, contents):
                if place.exists():
                    place.rename(Path(made) / "spoilt")
                try:
                    fresh.rename(place)
                except OSError:  # Another process has just made it.
                    if not _holds(place, contents):
                        raise
        os.utime(place)
    except OSError as error:
        raise _unwritable(cache, error) from error
    return place, contents


def _cache() -> Path:
    """Return the folder of all copies, after removal of the old ones."""
    root = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    cache = (root / "colift" / "submissions").absolute()
    try:
        cache.mkdir(mode=0o700, parents=True, exist_ok=True)
        old = time.time() - KEPT_DAYS * 24 * 3600
        for place in cache.iterdir():
            if place.stat().st_mtime < old:
                shutil.rmtree(place, ignore_errors=True)
    except OSError as error:
        raise _unwritable(cache, error) from error
    return cache


def _unwritable(cache: Path, error: OSError) -> InputError:
    return InputError(f"{unwritable(cache, error)}; or set XDG_CACHE_HOME to another folder")


def _holds(place: Path, contents: FolderContents) -> bool:
    """Return whether a copy is there, and unchanged."""
    try:
        return read_folder(place) == contents
    except InputError:
        return False
