"""TRC files of OpenSim, Cortex and Pose2Sim: three rows of settings, names, then frames."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.recordings.columns import place_of
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

BEFORE = 2
"""Columns before the positions: frame and time."""


def read(path: Path) -> tuple[Motion, ...]:
    """Return the markers.

    Raises
    ------
    InputError
        If a row of settings or the names are missing, or do not fit the frames.
    """
    where = str(path)
    text = text_in(path)
    delimiter = delimiter_of(text.split("\n")[:2000])
    lines = split_lines(text, delimiter)
    head = next((i for i, line in enumerate(lines) if line.at(0).lower().startswith("frame")), None)
    if head is None or head < 3:
        raise InputError(
            f"{where}: this TRC file has no row 'Frame#, Time, names': export it again"
        )
    keys = [cell.lower() for cell in lines[head - 2].cells]
    settings = dict(zip(keys, lines[head - 1].cells, strict=False))
    data = [line for line in lines[head + 1 :] if is_number(line.at(0))]
    width = max((len(line.cells) for line in data), default=0)
    names = _names(lines[head], width)
    if not names or not data:
        raise InputError(f"{where}: this TRC file has no markers, or no frames")
    decimal = decimal_sign(data, delimiter)
    unit, metre = stated_unit(settings.get("units") or "mm")
    hertz = rate_in(settings.get("datarate", ""))
    times = numbers(data, [1], ["Time"], decimal, where)[:, 0]
    clocked = bool(np.isfinite(times).all() and np.ptp(times) > 0.0)
    if not clocked:
        frames = numbers(data, [0], ["Frame#"], decimal, where)[:, 0]
        times, clocked = ((frames - frames[0]) / hertz, True) if hertz > 0.0 else (frames, False)
    firsts = [BEFORE + 3 * i for i in range(len(names))]
    return (
        Motion(
            kind="a TRC file",
            names=names,
            times=times,
            positions=metre * triples(data, firsts, names, decimal, where),
            places=np.array([line.number for line in data]),
            unit=unit,
            metre=metre,
            up="Y",
            clocked=clocked,
        ),
    )


def _names(head: Line, width: int) -> tuple[str, ...]:
    """Return the markers: one title for three columns, or one for each."""
    titles: Sequence[str] = [cell for cell in head.cells[BEFORE:] if cell]
    if len(titles) * 3 > width - BEFORE + 2:
        places = [place_of(title) for title in titles[::3]]
        titles = [place.point if place else "" for place in places]
    return tuple(titles) if all(titles) else ()
