"""A CSV file of recorded lifts: its table, and the lifts that it holds."""

import csv
import io
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final

import numpy as np
from colift.agents.humans.artefacts import fault
from colift.agents.humans.copies import first_copy
from colift.agents.humans.foreign_files import foreign_format
from colift.agents.humans.recording_notes import without_notes
from colift.agents.humans.recordings import COLUMNS, PERSON, Recording
from colift.base.errors import InputError
from colift.base.text import decoded, read_bytes

LARGEST: Final = 256 * 1024 * 1024
"""Largest file [bytes]: some hours at 1000 Hz."""

MISSING: Final = ("", "nan", "na", "n/a", "null", "none", "-", "--", "inf", "-inf")
"""Texts, in any case, for the height of a marker that was not seen."""

OTHER_NAMES: Final = {
    "trial": ("trial", "name", "lift", "take", "recording", "file", "id"),
    "t_s": ("t_s", "t", "time", "time_s", "time [s]", "time (s)", "seconds", "timestamp"),
    "z_m": ("z_m", "z", "height", "height_m", "height [m]", "height (m)", "y_m", "position_z"),
}
"""Names, in lower case, that other programs give to the columns."""

Sample = tuple[int, float, float]
"""Line, time [s] and height [m]."""


def load_recordings(path: str | Path) -> tuple[Recording, ...]:
    """Return the recordings of a CSV file with the columns ``trial,t_s,z_m``, in order.

    A column ``person`` names the person of each trial: lifts of one person are one unit in
    intervals and tests. Other columns are ignored. Heights [m] may have any origin within 10 m,
    times [s] any rate from 10 Hz.

    Raises
    ------
    InputError
        If the file cannot be read or has another format, a column is missing or there twice, a
        value is not a number, a trial has an artefact of :mod:`.artefacts` or two persons, two
        names are the same number, or two trials are the same lift. The message names the line and
        the cure.
    """
    path = Path(path)
    samples: dict[str, list[Sample]] = {}
    people: dict[str, str] = {}
    for trial, person, sample in _samples(path):
        samples.setdefault(trial, []).append(sample)
        if people.setdefault(trial, person) != person:
            raise InputError(
                f"{path}, line {sample[0]}: trial {trial!r:.80} is of person {person!r:.80}, and "
                f"of {people[trial]!r:.80} before: a trial is one lift of one person"
            )
    if not samples:
        raise InputError(f"{path}: no samples, needs rows of {','.join(COLUMNS)}")
    _check_names(path, samples)
    found = tuple(_recording(path, trial, people[trial], rows) for trial, rows in samples.items())
    copy = first_copy(found)
    if copy is not None:
        one, other = (found[i].name for i in copy)
        raise InputError(
            f"{path}, line {samples[other][0][0]}: trial {other!r:.80} is the same lift as "
            f"{one!r:.80}: keep one of them, since a copy would count as a further lift in "
            "intervals and tests"
        )
    return found


def _recording(path: Path, trial: str, person: str, rows: Sequence[Sample]) -> Recording:
    lines, times, heights = zip(*rows, strict=True)
    found = fault(np.array(times), np.array(heights))
    if found is not None:
        raise InputError(f"{path}, line {lines[found.sample]}: trial {trial!r:.80} {found.text}")
    return Recording(name=trial, times=times, heights=heights, person=person)


def _check_names(path: Path, samples: dict[str, list[Sample]]) -> None:
    """Refuse names that are the same number, such as ``1`` and ``1.0``."""
    numbers: dict[float, str] = {}
    for trial, rows in samples.items():
        try:
            number = float(trial)
        except ValueError:
            continue
        other = numbers.setdefault(number, trial)
        if other != trial:
            raise InputError(
                f"{path}, line {rows[0][0]}: the trials {other!r:.80} and {trial!r:.80} are the "
                "same number: write one lift's name in one form, or give two lifts different names"
            )


def _samples(path: Path) -> Iterator[tuple[str, str, Sample]]:
    """Yield trial, person and sample of each row; the person is empty if there is no column."""
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
        places = [header.index(column) for column in COLUMNS]
        who = header.index(PERSON) if PERSON in header else None
        for row in rows:
            where = f"{path}, line {reader.line_num}"
            if any(map(str.strip, row[len(header) :])):
                raise InputError(
                    f"{where}: {len(row)} fields, must be {len(header)} as in the header (decimal "
                    "commas? write points, as in 0.25)"
                )
            trial, time, height = (row[i].strip() if i < len(row) else "" for i in places)
            if not trial:
                raise InputError(f"{where}: trial is empty, must name the trial")
            seen = height.lower() not in MISSING
            person = row[who].strip() if who is not None and who < len(row) else ""
            yield (
                trial,
                person,
                (
                    reader.line_num,
                    _number(time, "t_s", where),
                    _number(height, "z_m", where) if seen else math.nan,
                ),
            )
    except csv.Error as error:
        raise InputError(f"{path}, line {reader.line_num}: not a CSV file: {error}") from None


def _check_header(path: Path, header: Sequence[str]) -> None:
    needed = ",".join(COLUMNS)
    if not any(header):
        raise InputError(f"{path}: empty file, needs the columns {needed}")
    for column in COLUMNS:
        if header.count(column) > 1:
            raise InputError(
                f"{path}: the column {column} is there {header.count(column)} times, must be there "
                "once: keep that of one marker"
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
