"""The rows of a CSV file of recorded lifts."""

import csv
import io
import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Final, NamedTuple

from colift.agents.humans.foreign_files import foreign_format
from colift.agents.humans.recording_notes import without_notes
from colift.agents.humans.recordings import BESIDE, COLUMNS, PERSON, PHASE
from colift.base.errors import InputError
from colift.base.text import decoded, read_bytes

LARGEST: Final = 256 * 1024 * 1024
"""Largest file [bytes]: some hours at 1000 Hz."""

MISSING: Final = ("", "nan", "na", "n/a", "null", "none", "-", "--", "inf", "-inf")
"""Texts, in any case, for the height of a marker that was not seen, or another missing value."""

ALL: Final[tuple[str, ...]] = (*COLUMNS, PERSON, PHASE, *BESIDE)
"""The columns that are read."""

OTHER_NAMES: Final = {
    "trial": ("trial", "name", "lift", "take", "recording", "file", "id"),
    "t_s": ("t_s", "t", "time", "time_s", "time [s]", "time (s)", "seconds", "timestamp"),
    "z_m": ("z_m", "z", "height", "height_m", "height [m]", "height (m)", "y_m", "position_z"),
}
"""Names, in lower case, that other programs give to the columns."""


class Row(NamedTuple):
    """A row: a sample of a trial."""

    line: int
    """Its number in the file."""
    trial: str
    person: str
    """Empty if the file names none."""
    phase: str
    """Empty if the file names none."""
    time: float
    """[s]"""
    height: float
    """[m], NaN if the marker was not seen."""
    beside: tuple[float, ...]
    """The values of :data:`.BESIDE`, NaN where there is none."""


def read_rows(path: Path) -> Iterator[Row]:
    """Yield the rows of a file.

    Raises
    ------
    InputError
        If the file cannot be read or has another format, a column is missing or there twice, or a
        value is not a number. The message names the line and the cure.
    """
    data = read_bytes(path, LARGEST)
    name = foreign_format(data)
    if name:
        raise InputError(
            f"{path}: this is {name}, must be a CSV file with the columns {','.join(COLUMNS)}: "
            "'colift recordings FILE --out lifts.csv' makes one of files of motion capture"
        )
    text = without_notes(decoded(data, str(path)))
    reader = csv.reader(io.StringIO(text, newline=""))
    rows = (row for row in reader if any(map(str.strip, row)))
    try:
        header = [column.strip() for column in next(rows, ())]
        _check_header(path, header)
        places = {name: header.index(name) for name in ALL if name in header}
        for row in rows:
            where = f"{path}, line {reader.line_num}"
            if any(map(str.strip, row[len(header) :])):
                raise InputError(
                    f"{where}: {len(row)} fields, must be {len(header)} as in the header (decimal "
                    "commas? write points, as in 0.25)"
                )
            fields = {name: row[i].strip() for name, i in places.items() if i < len(row)}
            yield _row(reader.line_num, fields, where)
    except csv.Error as error:
        raise InputError(f"{path}, line {reader.line_num}: not a CSV file: {error}") from None


def other_columns(path: Path) -> list[str]:
    """Return the names of the columns that are not read.

    Raises
    ------
    InputError
        If the file cannot be read.
    """
    text = decoded(read_bytes(path, LARGEST), str(path))
    rows = csv.reader(io.StringIO(text, newline=""))
    header = next((row for row in rows if "".join(row).strip() and not row[0].startswith("#")), [])
    return [name.strip() for name in header if name.strip() and name.strip() not in ALL]


def _row(line: int, fields: Mapping[str, str], where: str) -> Row:
    trial, time, height = COLUMNS
    if not fields.get(trial):
        raise InputError(f"{where}: trial is empty, must name the trial")
    phase = fields.get(PHASE, "")
    return Row(
        line=line,
        trial=fields[trial],
        person=fields.get(PERSON, ""),
        phase="" if phase.lower() in MISSING else phase,
        time=_number(fields.get(time, ""), time, where),
        height=_measured(fields, height, where),
        beside=tuple(_measured(fields, column, where) for column in BESIDE),
    )


def _measured(fields: Mapping[str, str], column: str, where: str) -> float:
    text = fields.get(column, "")
    return math.nan if text.lower() in MISSING else _number(text, column, where)


def _check_header(path: Path, header: Sequence[str]) -> None:
    needed = ",".join(COLUMNS)
    if not any(header):
        raise InputError(f"{path}: empty file, needs the columns {needed}")
    for column in ALL:
        if header.count(column) > 1:
            raise InputError(
                f"{path}: the column {column} is there {header.count(column)} times, must be there "
                "once: keep the right one"
            )
    missing = [column for column in COLUMNS if column not in header]
    if missing:
        shown = "".join(c if c.isprintable() else " " for c in ", ".join(header))
        raise InputError(
            f"{path}: missing column(s) {', '.join(missing)}; found {shown:.200}{_hint(header)}"
        )


def _hint(header: Sequence[str]) -> str:
    """Return the likely cause of a header without the columns; empty if there is none."""
    lower = [column.lower() for column in header]
    if header[0].startswith(("%", "//")):
        return f" (is this a comment? the first line must be {','.join(COLUMNS)})"
    if len(header) == 1:
        mark = "semicolons" if ";" in header[0] else "tabs" if "\t" in header[0] else ""
        found = f", not by {mark}" if mark else ""
        return (
            f" (are the columns separated by commas{found}? and write decimal points, as in 0.25)"
        )
    if all(column in lower for column in COLUMNS):
        return f" (write the names in lower case: {', '.join(COLUMNS)})"
    likely = [
        f"{name!r} to {column}"
        for column in COLUMNS
        if column not in header
        for name in header
        if name.lower() in OTHER_NAMES[column]
    ]
    return f" (rename the columns: {', '.join(likely)}?)" if likely else ""


def _number(text: str, column: str, where: str) -> float:
    try:
        value = float(text)
    except ValueError:
        hint = ""
        if text.count(",") == 1 and text.replace(",", "").lstrip("+-").isdecimal():
            hint = f", with a decimal point: {text.replace(',', '.')}"
        elif "," in text:
            hint = ", without separators of thousands, as in 1234.5"
        raise InputError(f"{where}: {column} is {text!r:.80}, must be a number{hint}") from None
    if not math.isfinite(value):
        raise InputError(f"{where}: {column} is {text!r:.80}, must be finite")
    return value
