"""CSV files of OptiTrack Motive: one line of settings, rows of types, names and axes, frames."""

from pathlib import Path

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.recordings.motion import Motion, stated_unit
from colift.benchmark.recordings.points import triples
from colift.benchmark.recordings.texts import (
    Line,
    decimal_sign,
    delimiter_of,
    is_number,
    numbers,
    rate_in,
    split_lines,
    text_in,
)


def read(path: Path) -> tuple[Motion, ...]:
    """Return the markers, rigid bodies and bones.

    Of a name that is there several times, such as a marker that was measured and computed from its
    body, the measured one, of the type ``Marker``, is taken.

    Raises
    ------
    InputError
        If the rows before the frames are not as Motive writes them.
    """
    where = str(path)
    text = text_in(path)
    delimiter = delimiter_of(text.split("\n")[:2000])
    lines = split_lines(text, delimiter)
    head = next((i for i, line in enumerate(lines) if line.at(0).lower() == "frame"), None)
    if head is None or head < 2:
        raise InputError(f"{where}: this file of Motive has no row 'Frame, Time': export it again")
    settings = lines[0].cells
    values = dict(zip(map(str.lower, settings[::2]), settings[1::2], strict=False))
    axes, kinds = lines[head], lines[head - 1]
    rows = {line.at(1).lower(): line for line in lines[1 : head - 1] if line.at(1)}
    unnamed = [line for line in lines[1 : head - 1] if not line.empty]
    types = rows.get("type") or (unnamed[0] if unnamed else kinds)
    names = rows.get("name") or (unnamed[1] if len(unnamed) > 1 else types)
    firsts = _firsts(axes, kinds, types, names)
    data = [line for line in lines[head + 1 :] if is_number(line.at(0))]
    if not firsts or not data:
        raise InputError(
            f"{where}: this file of Motive has no positions: export markers or rigid bodies with "
            "positions"
        )
    decimal = decimal_sign(data, delimiter)
    unit, metre = stated_unit(values.get("length units") or "Meters")
    timed = next(
        (i for i, cell in enumerate(axes.cells) if cell.lower().startswith("time (")), None
    )
    hertz = rate_in(values.get("export frame rate") or values.get("capture frame rate") or "")
    frames = numbers(data, [0], ["Frame"], decimal, where)[:, 0]
    if timed is not None:
        times = numbers(data, [timed], ["Time"], decimal, where)[:, 0]
    else:
        times = (frames - frames[0]) / hertz if hertz > 0.0 else frames
    return (
        Motion(
            kind="a CSV file of OptiTrack Motive",
            names=tuple(firsts),
            times=times,
            positions=metre * triples(data, [*firsts.values()], [*firsts], decimal, where),
            places=np.array([line.number for line in data]),
            unit=unit,
            metre=metre,
            up="Y",
            up_source="format",
            clocked=timed is not None or hertz > 0.0,
        ),
    )


def _firsts(axes: Line, kinds: Line, types: Line, names: Line) -> dict[str, int]:
    """Return the column of X of each point by its name."""
    found: dict[str, int] = {}
    measured: set[str] = set()
    for i, axis in enumerate(axes.cells):
        if axis.upper() != "X" or kinds.at(i).lower() != "position":
            continue
        name = names.at(i).strip('"') or f"column {i + 1}"
        if name not in found or (name not in measured and types.at(i).lower() == "marker"):
            found[name] = i
        if types.at(i).lower() == "marker":
            measured.add(name)
    return found
