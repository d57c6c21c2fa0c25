"""The kinds of motion files, known by their content, and their readers."""

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from tokenize import TokenError
from typing import Final

import numpy as np
from colift.agents.humans.foreign_files import (
    AMC,
    BVH,
    C3D,
    FIRST,
    MOTIVE,
    NUMPY,
    QUALISYS,
    ROSTOPIC,
    STO,
    TRC,
    VICON,
    foreign_format,
    remedy,
)
from colift.base.errors import InputError
from colift.base.text import read_bytes
from colift.benchmark.recordings.motion import Motion
from colift.benchmark.recordings.readers import (
    amc,
    arrays,
    bvh,
    c3d,
    motive,
    nuitrack,
    plain,
    qualisys,
    sto,
    trc,
    vicon,
)
from colift.benchmark.recordings.texts import LARGEST, text_of

Reader = Callable[[Path], tuple[Motion, ...]]

READERS: Final[Mapping[str, Reader]] = {
    VICON: vicon.read,
    QUALISYS: qualisys.read,
    MOTIVE: motive.read,
    TRC: trc.read,
    STO: sto.read,
    BVH: bvh.read,
    C3D: c3d.read,
    AMC: amc.read,
    NUMPY: arrays.read,
    ROSTOPIC: plain.read,
}
"""Readers by the name of a format in :mod:`.foreign_files`."""

BROKEN: Final = (
    *(ArithmeticError, AssertionError, EOFError, LookupError, MemoryError, StopIteration),
    *(SyntaxError, TokenError, TypeError, ValueError),
)
"""Errors of a reader at content that is not as its kind has it, or is cut off."""

NUITRACK: Final = re.compile(r"\d+,\d{12,14},\d+(,-?\d|\n)")
"""The start of a text of Nuitrack: number, time since 1970 [ms], number of joints."""


def read_motions(path: Path) -> tuple[Motion, ...]:
    """Return the motion of each take in a file, by the reader of its content.

    Numbers that are not finite are NaN, and points of one name are numbered.

    Raises
    ------
    InputError
        If the file cannot be read, is of a kind without a reader, or is not as its kind has it.
    """
    start = read_bytes(path, LARGEST)[: 16 * FIRST]
    if not start.strip():
        raise InputError(f"{path}: the file is empty")
    name = foreign_format(start) or foreign_format(_as_utf8(start, path))
    if name and name not in READERS:
        raise InputError(f"{path}: this is {name}, which colift does not read: {remedy(name)}")
    if not name and NUITRACK.match(_as_utf8(start, path).decode()):
        motions = _read(nuitrack.read, path, "a text of Nuitrack")
    else:
        motions = _read(READERS.get(name, plain.read), path, name or "a table of text")
    return tuple(motion.finite().told_apart() for motion in motions)


def _read(reader: Reader, path: Path, kind: str) -> tuple[Motion, ...]:
    """Return the motions of a file, or refuse it if the reader breaks off at its content."""
    try:
        with np.errstate(all="ignore"):
            return reader(path)
    except (InputError, OSError):
        raise
    except BROKEN as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        raise InputError(
            f"{path}: this begins as {kind}, but cannot be read as one ({reason:.100}): export or "
            "copy it again"
        ) from None


def _as_utf8(start: bytes, path: Path) -> bytes:
    """Return the start of a text in any encoding as UTF-8."""
    return text_of(start, str(path)).encode()
