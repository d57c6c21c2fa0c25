"""STO and MOT files of OpenSim: settings up to ``endheader``, titles of columns, then frames."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.recordings.columns import places_of
from colift.benchmark.recordings.motion import Motion
from colift.benchmark.recordings.points import scattered
from colift.benchmark.recordings.texts import (
    Line,
    check_widths,
    decimal_sign,
    delimiter_of,
    is_number,
    numbers,
    split_lines,
    text_in,
)
from numpy.typing import NDArray


def read(path: Path) -> tuple[Motion, ...]:
    """Return the points whose coordinates are columns, such as ``hand_tx``, ``hand_ty``.

    Raises
    ------
    InputError
        If there is no column of times or none of positions, as in files of angles or forces.
    """
    where = str(path)
    text = text_in(path)
    rows = text.split("\n")
    end = next(i for i, row in enumerate(rows) if row.lower().startswith("endheader"))
    delimiter = delimiter_of(rows[end + 1 : end + 2000])
    vectors = any(row.lower().replace(" ", "").startswith("datatype=vec3") for row in rows[:end])
    if vectors and delimiter == ",":
        delimiter = " "
    head, *data = split_lines("\n".join(rows[end + 1 :]), delimiter, end + 2) or [Line(0, ())]
    data = [line for line in data if is_number(line.at(0))]
    titles = list(head.cells)
    if not titles or titles[0].lower() != "time" or not data:
        raise InputError(f"{where}: this file of OpenSim has no column 'time', or no frames")
    if vectors:
        names, positions, decimal = tuple(titles[1:]), _vectors(data, titles, where), "."
    else:
        check_widths(data, len(titles), where)
        decimal = decimal_sign(data, delimiter)
        places = places_of(titles, [""] * len(titles), where)
        if not places:
            shown = ", ".join(titles[1:6])
            raise InputError(
                f"{where}: no column of this file is a position, such as hand_ty or hand_Y (it has "
                f"{shown}, ...): export positions, by OpenSim's BodyKinematics or PointKinematics"
            )
        names, positions = scattered(data, places, titles, decimal, where)
    return (
        Motion(
            kind="a STO or MOT file of OpenSim",
            names=names,
            times=numbers(data, [0], ["time"], decimal, where)[:, 0],
            positions=positions,
            places=np.array([line.number for line in data]),
            unit="m",
            metre=1.0,
            up="Y",
            up_source="format",
        ),
    )


def _vectors(data: Sequence[Line], titles: Sequence[str], where: str) -> NDArray[np.float64]:
    """Return the positions of points that are fields of three numbers with commas."""
    flat = [
        Line(
            line.number, tuple(part.strip() for cell in line.cells[1:] for part in cell.split(","))
        )
        for line in data
    ]
    columns = range(3 * (len(titles) - 1))
    named = [title for title in titles[1:] for _ in range(3)]
    return numbers(flat, columns, named, ".", where).reshape(len(data), len(titles) - 1, 3)
