"""The times of a table: numbers in any unit, times of day, dates, or the numbers of frames."""

import re
from collections.abc import Sequence
from datetime import UTC, datetime
from typing import Final, NamedTuple

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.recordings.columns import FRAMES, plain_name, time_unit, without_unit
from colift.benchmark.recordings.headers import Table, check_single, column_of_times
from colift.benchmark.recordings.motion import Series
from colift.benchmark.recordings.texts import Line, is_number, numbers

EPOCHS: Final = ((1e17, 1e-9), (1e14, 1e-6), (1e11, 1e-3))
"""Least number and unit [s] of times since 1970 of this century, finest unit first."""

DAY_TIME: Final = re.compile(r"(?:(\d+):)?(\d{1,2}):(\d{1,2}(?:[.,]\d+)?)")
"""Hours, if any, minutes and seconds."""


class Clock(NamedTuple):
    """The times of a table."""

    values: Series
    """[s] from the first row, or the numbers of the frames, shape (rows,)."""
    seconds: bool
    """Whether they are times."""
    unit: float = 1.0
    """Seconds per unit of the table, by which they were multiplied."""


def clock_of(table: Table, where: str) -> Clock:
    """Return the times of a table; the numbers of its frames, or its rows, if it has none.

    Raises
    ------
    InputError
        If a field is no time, or the column is there twice.
    """
    column = column_of_times(table, where)
    if column is not None:
        return _times(table, column, where)
    frames = [i for i, title in enumerate(table.titles) if plain_name(title) in FRAMES]
    numbered = [i for i in frames if is_number(table.lines[0].at(i))]
    if numbered:
        column = numbered[0]
        check_single(table, column, where)
        values = numbers(table.lines, [column], [table.titles[column]], table.decimal, where)[:, 0]
    else:
        values = np.arange(len(table.lines), dtype=float)
    if table.rate > 0.0:
        return Clock((values - values[0]) / table.rate, seconds=True)
    return Clock(values, seconds=False)


def _times(table: Table, column: int, where: str) -> Clock:
    title = table.titles[column]
    if not is_number(table.lines[0].at(column)):
        moments = np.array([_moment(line, column, title, where) for line in table.lines])
        return Clock(moments - moments[0], seconds=True)
    values = numbers(table.lines, [column], [title], table.decimal, where)[:, 0]
    finer = _nanoseconds(table.titles, title)
    if finer is not None:
        parts = numbers(table.lines, [finer], ["nsecs"], table.decimal, where)[:, 0]
        return Clock(values - values[0] + 1e-9 * parts, seconds=True)
    unit = time_unit(title) or time_unit(f"{title} [{table.units[column]}]") or 0.0
    largest = float(np.nanmax(np.abs(values)))
    for least, epoch in EPOCHS:  # A year is beyond doubt, whatever the title says.
        if largest >= least:
            unit = epoch
            break
    return Clock((values - values[0]) * (unit or 1.0), seconds=True, unit=unit or 1.0)


def _nanoseconds(titles: Sequence[str], title: str) -> int | None:
    """Return the column with the nanoseconds to a column of whole seconds; None without one."""
    if not title.lower().endswith(("secs", "sec")):
        return None
    stem = re.sub(r"secs?$", "", title, flags=re.IGNORECASE)
    wanted = {f"{stem}{name}".lower() for name in ("nsecs", "nsec", "nanosec", "nanosecs")}
    return next((i for i, each in enumerate(titles) if each.lower() in wanted), None)


def _moment(line: Line, column: int, title: str, where: str) -> float:
    """Return the seconds of a date or a time of day."""
    text = line.at(column)
    found = DAY_TIME.fullmatch(text)
    if found:
        hours, minutes, seconds = found.groups()
        return 3600.0 * float(hours or 0) + 60.0 * float(minutes) + float(seconds.replace(",", "."))
    try:
        moment = datetime.fromisoformat(text)
    except ValueError:
        raise InputError(
            f"{where}, line {line.number}: {without_unit(title)[0]} is {text!r:.40}, must be "
            "seconds, a time of day such as 10:11:12.345, or a date as in ISO 8601"
        ) from None
    return (moment if moment.tzinfo else moment.replace(tzinfo=UTC)).timestamp()
