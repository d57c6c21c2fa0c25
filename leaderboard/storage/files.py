"""Atomic and durable writes of files."""

import json
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec


def write_json(
    path: Path, content: Mapping[str, Any], *, mode: int = 0o644, indent: int | None = 2
) -> None:
    """Write a JSON file atomically: readers see the old file or the new one."""
    separators = (",", ":") if indent is None else None
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}-")
    try:
        with os.fdopen(handle, "w") as file:
            os.fchmod(file.fileno(), mode)
            text = json.dumps(content, indent=indent, separators=separators, allow_nan=False)
            file.write(text + "\n")
            file.flush()
            os.fsync(file.fileno())
        Path(temporary).replace(path)
        sync(path.parent)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def sync(path: Path) -> None:
    """Wait until a file's content, or a folder's names, would survive a power failure."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def sync_tree(folder: Path) -> None:
    """Wait until all content of a folder would survive a power failure."""
    for place, _, names in os.walk(folder, topdown=False):
        for name in names:
            sync(Path(place, name))
        sync(Path(place))


def read_json(path: Path) -> dict[str, Any]:
    """Return the object in a JSON file, whose numbers are finite.

    Raises
    ------
    ValueError
        If it is anything else.
    """
    try:
        return msgspec.json.decode(path.read_bytes(), type=dict[str, Any])
    except msgspec.MsgspecError as error:
        raise ValueError(str(error)) from error
