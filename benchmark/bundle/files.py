"""The files of a bundle: written all or nothing, read without trust."""

import json
import os
import shutil
import stat
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Final

from colift.base.errors import InputError
from colift.base.places import check_beside

RESULTS: Final = "results.json"
EPISODES: Final = "episodes.csv"
TRACES: Final = "traces.npz"
MANIFEST: Final = "manifest.json"
RECORDINGS: Final = "recordings.csv"
INPUTS: Final = "inputs.npz"
LOGS: Final = "logs.json"

FILES: Final = (RESULTS, EPISODES, TRACES, MANIFEST)
"""The files of every bundle."""

HARDWARE: Final = "hardware"
"""Key in the results for the robot and the motion capture, if people lifted with a robot."""

LARGEST: Final[Mapping[str, int]] = {
    RESULTS: 2**24,
    EPISODES: 2**26,
    TRACES: 2**31,
    MANIFEST: 2**24,
    RECORDINGS: 2**26,
    INPUTS: 2**27,
    LOGS: 2**24,
}
"""All files that a bundle can have, and their largest sizes [bytes]."""


def is_bundle(folder: Path) -> bool:
    """Return whether a folder has the results of a bundle, even of a damaged one."""
    return (folder / RESULTS).is_file()


def check_bundle_folder(folder: Path) -> None:
    """Refuse a folder to which a bundle cannot be written, before any work is done.

    Raises
    ------
    InputError
        If it holds files other than a bundle's, or cannot be created or written to.
    """
    if folder.exists():
        if not folder.is_dir():
            raise InputError(f"{folder} is a file, must be a folder")
        others = sorted({path.name for path in folder.iterdir()} - set(LARGEST))
        if others:
            raise InputError(f"{folder} holds other files ({others[0]}); name a new folder")
    check_beside(folder)


def check_unfinished(folder: Path) -> None:
    """Refuse a folder that holds a finished bundle.

    Raises
    ------
    InputError
        If it does, or if the state of the bundle there cannot be determined.
    """
    try:
        content = json.loads((folder / RESULTS).read_bytes())
    except FileNotFoundError:
        return
    except (OSError, ValueError):
        content = {}
    if isinstance(content, dict) and content.get("complete") is False:
        return
    raise InputError(f"{folder} holds a finished result bundle; name a new folder")


@contextmanager
def replaced_folder(folder: Path) -> Iterator[Path]:
    """Yield an empty folder that takes the place of another: if the body ends well, or not at all.

    Raises
    ------
    InputError
        As :func:`check_bundle_folder`.
    """
    check_bundle_folder(folder)
    with tempfile.TemporaryDirectory(dir=folder.parent) as temporary:
        made = Path(temporary) / "bundle"
        made.mkdir()
        yield made
        if folder.exists():
            shutil.move(folder, Path(temporary) / "older")
        made.rename(folder)


def read_files(folder: Path) -> dict[str, bytes]:
    """Return the content of the files of a bundle by name, each read once.

    Anything else in the folder is not looked at; see :func:`other_files`.

    Raises
    ------
    InputError
        If there is no such folder, one of :data:`FILES` is missing, one of :data:`LARGEST` is not a
        plain file, or is too large.
    """
    names = _names(folder)
    for name in FILES:
        if name not in names:
            raise InputError(f"{name}: it is missing")
    return {name: _read(folder / name) for name in names if name in LARGEST}


def other_files(folder: Path) -> list[str]:
    """Return the names in a bundle's folder that are none of a bundle, except hidden ones.

    Somebody may have put notes or pictures there. They are not hashed, and change nothing.

    Raises
    ------
    InputError
        If there is no such folder.
    """
    return [name for name in _names(folder) if name not in LARGEST and not name.startswith(".")]


def _names(folder: Path) -> list[str]:
    try:
        return sorted(path.name for path in folder.iterdir())
    except OSError as error:
        raise InputError(f"{folder}: not a bundle's folder: {error.strerror}") from None


def _read(path: Path) -> bytes:
    """Return the content of a plain file; a link, a pipe or a device is refused unread."""
    largest = LARGEST[path.name]
    try:
        handle = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
        with os.fdopen(handle, "rb") as file:
            if not stat.S_ISREG(os.fstat(handle).st_mode):
                raise InputError(f"{path.name}: not a plain file")
            data = file.read(largest + 1)
    except OSError as error:
        reason = "it is a link" if path.is_symlink() else error.strerror
        raise InputError(f"{path.name}: cannot be read: {reason}") from None
    if len(data) > largest:
        raise InputError(f"{path.name}: larger than {largest} bytes")
    return data
