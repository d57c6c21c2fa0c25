"""TSV files of Qualisys Track Manager: keywords with values, then frames.

A row of column titles, and the columns of frame and time, are options of the export.
"""

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Final

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.recordings.motion import Motion
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

KEYWORD: Final = re.compile(r"[A-Z][A-Z0-9_]*")
NAMES: Final = ("MARKER_NAMES", "BODY_NAMES", "SEGMENT_NAMES", "TRAJECTORY_NAMES")
BODY_COLUMNS: Final = 16
"""Columns of a body: X, Y, Z, Roll, Pitch, Yaw, Residual and nine of the rotation matrix."""


def read(path: Path) -> tuple[Motion, ...]:
    """Return the markers or bodies.

    Raises
    ------
    InputError
        If names or frames are missing, or do not fit together.
    """
    where = str(path)
    text = text_in(path)
    delimiter = delimiter_of(text.split("\n")[:2000])
    lines = split_lines(text, delimiter)
    start = next((i for i, line in enumerate(lines) if is_number(line.at(0))), len(lines))
    keywords = {line.at(0).upper(): line.cells[1:] for line in lines[:start]}
    named = next((keywords[key] for key in NAMES if keywords.get(key)), ())
    titles = (
        lines[start - 1].cells if start and not KEYWORD.fullmatch(lines[start - 1].at(0)) else ()
    )
    names = [name for name in named if name]
    data = [line for line in lines[start:] if not line.empty]
    if not names or not data:
        raise InputError(f"{where}: this file of Qualisys has no markers, or no frames")
    width = max(len(line.cells) for line in data[:50])
    width -= all(not line.at(width - 1) for line in data[:50])
    before = _leading(titles) if titles else width % 3
    stride = BODY_COLUMNS if "6D" in keywords.get("DATA_INCLUDED", ()) else 3
    if stride == BODY_COLUMNS and not titles:
        before = width - stride * len(names)
    if width < before + stride * (len(names) - 1) + 3:
        raise InputError(
            f"{where}: {len(names)} names but {width - before} columns of positions in line "
            f"{data[0].number}: export the file again"
        )
    decimal = decimal_sign(data, delimiter)
    firsts = [before + stride * i for i in range(len(names))]
    times, clocked = _times(data, titles, before, keywords, decimal, where)
    return (
        Motion(
            kind="a TSV file of Qualisys",
            names=tuple(names),
            times=times,
            positions=0.001 * triples(data, firsts, names, decimal, where),
            places=np.array([line.number for line in data]),
            unit="mm",
            metre=0.001,
            up="Z",
            up_source="format",
            clocked=clocked,
        ),
    )


def _leading(titles: Sequence[str]) -> int:
    """Return the number of columns before the positions."""
    plain = [title.lower() for title in titles]
    return sum(title in ("frame", "time", "smpte", "sample") for title in plain)


def _times(
    data: Sequence[Line],
    titles: Sequence[str],
    before: int,
    keywords: dict[str, tuple[str, ...]],
    decimal: str,
    where: str,
) -> tuple[np.ndarray[tuple[int], np.dtype[np.float64]], bool]:
    """Return times [s] and True, or the numbers of the frames and False."""
    plain = [title.lower() for title in titles]
    column = plain.index("time") if "time" in plain else 1 if before == 2 and not titles else None
    if column is not None:
        return numbers(data, [column], ["Time"], decimal, where)[:, 0], True
    frames = np.arange(len(data), dtype=float)
    if before:
        frames = numbers(data, [0], ["Frame"], decimal, where)[:, 0]
    hertz = rate_in((keywords.get("FREQUENCY") or ("",))[0])
    return ((frames - frames[0]) / hertz, True) if hertz > 0.0 else (frames, False)
