"""CSV files of Vicon Nexus: sections, each with its rate, names, axes, units and frames."""

from collections.abc import Sequence
from pathlib import Path
from typing import Final

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.recordings.motion import LENGTH_NAMES, Motion, stated_unit
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

SECTIONS: Final = ("Trajectories", "Joints", "Segments", "Model Outputs")
"""Sections with positions, the most usual first; others have forces and signals."""

OTHERS: Final = ("Devices", "Events", "Force Plates")

STARTS: Final = ("X", "TX")
"""Names of the first column of a position."""


def read(path: Path) -> tuple[Motion, ...]:
    """Return the points of the trajectories, or of the joints, segments or model outputs.

    Raises
    ------
    InputError
        If the file has no section with positions, or a section is not as Nexus writes it.
    """
    text = text_in(path)
    delimiter = delimiter_of(text.split("\n")[:2000])
    lines = split_lines(text, delimiter)
    titles = {
        line.at(0).casefold(): i
        for i, line in reversed([*enumerate(lines)])
        if not any(line.cells[1:]) and line.at(0).casefold() in map(str.casefold, SECTIONS + OTHERS)
    }
    for section in SECTIONS:
        start = titles.get(section.casefold())
        found = None if start is None else _section(lines[start + 1 :], delimiter, str(path))
        if found is not None:
            return (found,)
    there = ", ".join(lines[i].at(0) for i in sorted(titles.values()))
    raise InputError(
        f"{path}: this is a file of Vicon Nexus without positions (it has {there}): export the "
        "trajectories"
    )


def _section(lines: Sequence[Line], delimiter: str, where: str) -> Motion | None:
    """Return the points of a section; None if its columns are no positions."""
    head = next((i for i, line in enumerate(lines) if line.at(0).lower() == "frame"), None)
    if head is None or head < 1:
        raise InputError(
            f"{where}: the section has no row 'Frame, Sub Frame, X, Y, Z': export it again"
        )
    rate = next((line.at(0) for line in lines[:head] if is_number(line.at(0))), "")
    axes, names = lines[head], lines[head - 1]
    units = lines[head + 1] if head + 1 < len(lines) else Line(0, ())
    firsts = [
        i
        for i, axis in enumerate(axes.cells)
        if axis.upper() in STARTS and units.at(i).lower() in LENGTH_NAMES
    ]
    data = _data(lines[head + 2 :])
    if not firsts or not data:
        return None
    decimal = decimal_sign(data, delimiter)
    named = [_name_at(names, i) for i in firsts]
    unit, metre = stated_unit(units.at(firsts[0]))
    frames = numbers(data, [0], ["Frame"], decimal, where)[:, 0]
    hertz = rate_in(rate)
    return Motion(
        kind="a CSV file of Vicon Nexus",
        names=tuple(named),
        times=(frames - frames[0]) / hertz if hertz > 0.0 else frames,
        positions=metre * triples(data, firsts, named, decimal, where),
        places=np.array([line.number for line in data]),
        unit=unit,
        metre=metre,
        up="Z",
        up_source="format",
        clocked=hertz > 0.0,
    )


def _data(lines: Sequence[Line]) -> list[Line]:
    """Return the lines up to the end of the section."""
    stop = next((i for i, line in enumerate(lines) if not is_number(line.at(0))), len(lines))
    return [*lines[:stop]]


def _name_at(names: Line, column: int) -> str:
    """Return the name over a column: the last one up to it."""
    return next((cell for cell in reversed(names.cells[: column + 1]) if cell), f"column {column}")
