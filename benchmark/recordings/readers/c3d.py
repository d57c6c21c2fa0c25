"""C3D files, the binary format of motion capture; read by ezc3d, of the extra ``c3d``."""

import importlib.util
import io
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np
from colift.base.errors import InputError
from colift.base.extras import how_to_install
from colift.benchmark.recordings.motion import Motion, stated_unit

UNIT: Final = "mm"
"""The unit where the file states none, as the format's manual has it (www.c3d.org)."""

LONGEST: Final = 300.0
"""Longest time to read a file [s]."""

PROCESS: Final = Path(__file__).with_name("c3d_process.py")
"""The program that reads."""

MOST_FRAMES: Final = 65535
"""Largest number of a frame in a header; longer recordings have another one there."""


def read(path: Path) -> tuple[Motion, ...]:
    """Return the points.

    Raises
    ------
    InputError
        If ezc3d is not installed or cannot read the file, or it has no points.
    """
    if importlib.util.find_spec("ezc3d") is None:
        raise InputError(
            f"{path}: this is a C3D file, which is read by the library ezc3d: "
            f"{how_to_install('c3d')}"
        )
    content = _content(path)
    points, first = content["points"], int(content["first"])
    names = _labels(content, points.shape[1])
    count = points.shape[2]
    if not names or not count:
        raise InputError(f"{path}: this C3D file has no points, or no frames: export the markers")
    said = int(content["last"]) - first + 1
    if count < said <= MOST_FRAMES:
        raise InputError(
            f"{path}: this C3D file has {count} frames, its header says {said}: the file was cut "
            "off; copy or export it again"
        )
    rate = float(content["rate"])
    told = _first(content, "UNITS")
    unit, metre = stated_unit(told or UNIT)
    up = _up(_first(content, "Y_SCREEN"))
    return (
        Motion(
            kind="a C3D file",
            names=names,
            times=np.arange(count, dtype=np.float64) / (rate if rate > 0.0 else 1.0),
            positions=metre * points[:3].transpose(2, 1, 0),
            places=np.arange(first, first + count),
            place="frame",
            unit=unit if told else "",
            metre=metre,
            up=up or "Z",
            up_source="file" if up else "",
            clocked=rate > 0.0,
        ),
    )


def _content(path: Path) -> Mapping[str, Any]:
    """Return what :mod:`.c3d_process` finds in a file."""
    command = [sys.executable, str(PROCESS), str(path)]
    try:
        done = subprocess.run(command, capture_output=True, timeout=LONGEST)
        reason = done.stderr.decode(errors="replace").strip()
    except subprocess.TimeoutExpired:
        done, reason = None, f"it takes more than {LONGEST:g} s"
    if done is None or done.returncode:
        last = reason.splitlines()[-1] if reason else "ezc3d breaks off"
        raise InputError(
            f"{path}: this begins as a C3D file, but cannot be read as one ({last:.100}): export "
            "or copy it again"
        )
    content: Mapping[str, Any] = np.load(io.BytesIO(done.stdout), allow_pickle=False)
    return content


def _first(content: Mapping[str, Any], name: str) -> str:
    """Return the first text of a parameter; empty if the file has none."""
    return str(content[name][0]).strip() if name in content and len(content[name]) else ""


def _labels(content: Mapping[str, Any], count: int) -> tuple[str, ...]:
    """Return the names of the points; more than 255 go on in ``LABELS2`` and so on."""
    keys = ["LABELS", *(f"LABELS{i}" for i in range(2, 2 + count // 255))]
    labels = [str(label).strip() for key in keys if key in content for label in content[key]]
    labels = [*labels[:count], *[""] * (count - len(labels))]
    return tuple(label or f"point {i + 1}" for i, label in enumerate(labels))


def _up(screen: str) -> str:
    """Return the axis that is upwards on the screen, such as ``Z``; empty if it is none."""
    axis = screen.upper().removeprefix("+")
    return axis if axis.removeprefix("-") in ("X", "Y", "Z") else ""
