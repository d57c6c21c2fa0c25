"""The head of a table of text: comments, settings, rows of titles and units, first row of data."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

from colift.base.errors import InputError
from colift.benchmark.recordings.columns import SECONDS, place_of, plain_name, time_unit
from colift.benchmark.recordings.motion import LENGTH_NAMES
from colift.benchmark.recordings.texts import (
    Line,
    check_widths,
    decimal_sign,
    delimiter_of,
    is_number,
    split_lines,
)

COMMENTS: Final = ("#", "%", "//", "!")
"""Marks at the start of a comment."""

UNITS: Final = frozenset(
    (*LENGTH_NAMES, *SECONDS, "deg", "rad", "px", "pixels", "n", "nm", "-", "hz", "1", "degrees")
)
"""Words of a row of units, in lower case."""

RATE: Final = re.compile(
    r"(?:\b(?:rate|frequency|fps|freq|frame rate|sampling)\b\D{0,24}?)(\d+(?:[.,]\d+)?)"
    r"|(\d+(?:[.,]\d+)?)\s*(?:hz|fps)\b",
    re.IGNORECASE,
)
"""A rate in a comment or a line of settings."""


MOMENT: Final = re.compile(r"\d{4}-\d\d-\d\d[T ]\d|(\d+:)?\d{1,2}:\d{1,2}([.,]\d+)?$")
"""A date with a time in ISO 8601, or a time of day: hours, if any, minutes and seconds."""

VALUE: Final = re.compile(r"[+-]?[.,]?\d")
"""The start of a number, a time of day or a date."""


@dataclass(frozen=True, kw_only=True)
class Table:
    """A table with its titles."""

    titles: tuple[str, ...]
    units: tuple[str, ...]
    """Unit of each column in a row of units; empty if there is none."""
    lines: tuple[Line, ...]
    """The data."""
    decimal: str
    """The decimal sign."""
    rate: float
    """Samples per second by a comment or a setting; 0 if none states it."""


def table_of(text: str, where: str) -> Table:
    """Return the table in a text.

    Raises
    ------
    InputError
        If it has no rows of numbers or no titles, or a row has more fields than there are titles.
    """
    rows = text.split("\n")
    notes = {i for i, row in enumerate(rows) if _is_comment(row)}
    bare = "\n".join("" if i in notes else row for i, row in enumerate(rows))
    delimiter = delimiter_of(bare.split("\n")[:2000])
    lines = [line for line in split_lines(bare, delimiter) if not line.empty]
    first = next((i for i, line in enumerate(lines) if _is_data(lines, i)), None)
    if first is None:
        raise InputError(
            f"{where}: no table of numbers: must have a row of titles, and rows of times and "
            "positions"
        )
    width = len(lines[first].cells)
    least = max(2, width // 2)
    top = first
    while top and len(lines[top - 1].cells) >= least and not _numeric(lines[top - 1]):
        top -= 1
    heads = lines[top:first] or _commented(rows, notes, delimiter, width)
    data = lines[first:]
    if heads:
        titles, units = _titles(heads, max(len(each.cells) for each in heads))
    else:
        titles = _guessed(data, where)
        units = ("",) * len(titles)
    check_widths(data, len(titles), where)
    settings = [rows[i] for i in sorted(notes)] + [" ".join(each.cells) for each in lines[:first]]
    return Table(
        titles=titles,
        units=units,
        lines=tuple(data),
        decimal=decimal_sign(data, delimiter),
        rate=_rate(settings),
    )


def _is_comment(row: str) -> bool:
    return row.lstrip(' "').startswith(COMMENTS) and not row.lower().startswith("%time")


def _numeric(line: Line) -> bool:
    return sum(VALUE.match(cell) is not None for cell in line.cells) >= 2


def _is_data(lines: Sequence[Line], i: int) -> bool:
    """Return whether a line has numbers, and the next one as many fields."""
    if not _numeric(lines[i]):
        return False
    after = lines[i + 1] if i + 1 < len(lines) else lines[i]
    return _numeric(after) and abs(len(after.cells) - len(lines[i].cells)) <= 1


def _commented(rows: Sequence[str], notes: set[int], delimiter: str, width: int) -> list[Line]:
    """Return the last comment as a row of titles, if it has as many fields as the table."""
    for i in sorted(notes, reverse=True):
        text = rows[i].lstrip(' "').lstrip("".join(COMMENTS)).strip()
        found = split_lines(text, delimiter, i + 1)
        if found and len(found[0].cells) == width:
            return found[:1]
    return []


def _titles(heads: Sequence[Line], width: int) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return a title and a unit for each column, from one or more rows."""
    rows = [*heads]
    units = ("",) * width
    if len(rows) > 1 and all(
        not cell or cell.strip("[]()").lower() in UNITS for cell in rows[-1].cells
    ):
        units = tuple(rows[-1].at(i).strip("[]()") for i in range(width))
        rows = rows[:-1]
    if not rows:
        return ("",) * width, units
    titles = [rows[-1].at(i) for i in range(width)]
    if len(rows) > 1:
        above, name = rows[-2], ""
        for i, title in enumerate(titles):
            name = above.at(i) or name
            place = place_of(title)
            if place is not None and not place.point and plain_name(name) not in ("coords", "time"):
                titles[i] = f"{name} {title}".strip()
            elif not title:
                titles[i] = above.at(i)
    return tuple(titles), units


def _guessed(data: Sequence[Line], where: str) -> tuple[str, ...]:
    """Return titles for a table without them: a time and a height, or a time and a point."""
    width = len(data[0].cells)
    texts = [line.at(0).replace(",", ".") for line in data[:50]]
    times = [float(text) for text in texts if is_number(text)]
    rising = all(before < after for before, after in pairwise(times))
    if rising and width in (2, 4):
        return ("time", "z") if width == 2 else ("time", "x", "y", "z")
    raise InputError(
        f"{where}, line {data[0].number}: {width} columns without titles: write their names into "
        "the first line, such as time,RHand X,RHand Y,RHand Z"
    )


def _rate(settings: Sequence[str]) -> float:
    for text in settings:
        found = RATE.search(text)
        if found:
            return float((found[1] or found[2]).replace(",", "."))
    return 0.0


def check_single(table: Table, column: int, where: str) -> None:
    """Refuse a column that is read if another one has its title: which of them is right is unknown.

    Raises
    ------
    InputError
        If there is such a column.
    """
    title = plain_name(table.titles[column])
    count = sum(plain_name(each) == title for each in table.titles)
    if title and count > 1:
        raise InputError(
            f"{where}: the column {table.titles[column]!r:.40} is there {count} times, must be "
            "there once: keep the right one"
        )


def column_of_times(table: Table, where: str) -> int | None:
    """Return the index of the column of times; None if there is none.

    The time of measurement, in a message's header, goes before that of its arrival.

    Raises
    ------
    InputError
        If it is there twice.
    """
    found = [i for i, title in enumerate(table.titles) if time_unit(title) is not None]
    found += [i for i in range(len(table.titles)) if MOMENT.match(table.lines[0].at(i))]
    stamps = [i for i in found if "header" in plain_name(table.titles[i]).split()]
    column = next(iter(stamps or found), None)
    if column is not None:
        check_single(table, column, where)
    return column
