"""C3D files, the binary format of motion capture; read by ezc3d, of the extra ``c3d``."""

from pathlib import Path
from typing import Any, Final

import numpy as np
from colift.base.errors import InputError
from colift.base.extras import how_to_install
from colift.benchmark.recordings.motion import Motion, stated_unit

UNIT: Final = "mm"
"""The unit where the file states none, as the format's manual has it (www.c3d.org)."""


def read(path: Path) -> tuple[Motion, ...]:
    """Return the points.

    Raises
    ------
    InputError
        If ezc3d is not installed or cannot read the file, or it has no points.
    """
    try:
        import ezc3d
    except ImportError:
        raise InputError(
            f"{path}: this is a C3D file, which is read by the library ezc3d: "
            f"{how_to_install('c3d')}"
        ) from None
    try:
        content = ezc3d.c3d(str(path))
    except (OSError, RuntimeError, ValueError, IndexError, MemoryError) as error:
        raise InputError(
            f"{path}: this begins as a C3D file, but cannot be read as one ({error!s:.100}): "
            "export or copy it again"
        ) from None
    group = content["parameters"]["POINT"]
    header = content["header"]["points"]
    points = content["data"]["points"]
    names = _labels(group, points.shape[1])
    rate = float(next(iter(_values(group, "RATE")), 0.0)) or float(header["frame_rate"])
    first, last = int(header["first_frame"]), int(header["last_frame"])
    count = points.shape[2]
    if not names or not count:
        raise InputError(f"{path}: this C3D file has no points, or no frames: export the markers")
    if count < last - first + 1 <= 65535:
        raise InputError(
            f"{path}: this C3D file has {count} frames, its header says {last - first + 1}: the "
            "file was cut off; copy or export it again"
        )
    told = "".join(map(str, _values(group, "UNITS")[:1])).strip()
    unit, metre = stated_unit(told or UNIT, str(path))
    up = _up(group)
    return (
        Motion(
            kind="a C3D file",
            names=names,
            times=np.arange(count) / rate if rate > 0.0 else np.arange(count, dtype=float),
            positions=metre * points[:3].transpose(2, 1, 0),
            places=np.arange(first + 1, first + 1 + count),
            place="frame",
            unit=unit if told else "",
            metre=metre,
            up=up or "Z",
            up_source="file" if up else "",
            clocked=rate > 0.0,
        ),
    )


def _values(group: Any, name: str) -> list[Any]:
    """Return the values of a parameter; empty if the file has none."""
    return [*group[name]["value"]] if name in group else []


def _labels(group: Any, count: int) -> tuple[str, ...]:
    """Return the names of the points; more than 255 go on in ``LABELS2`` and so on."""
    keys = ["LABELS", *(f"LABELS{i}" for i in range(2, 2 + count // 255))]
    labels = [str(label).strip() for key in keys for label in _values(group, key)][:count]
    labels += [""] * (count - len(labels))
    return tuple(label or f"point {i + 1}" for i, label in enumerate(labels))


def _up(group: Any) -> str:
    """Return the axis that is upwards on the screen, such as ``Z``; empty if the file has none."""
    told = "".join(map(str, _values(group, "Y_SCREEN")[:1])).strip().upper()
    return told.removeprefix("+") if told.lstrip("+-") in ("X", "Y", "Z") else ""
