"""The text of a laboratory's file: its encoding, its delimiter, its decimal sign, its numbers."""

import codecs
import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from colift.base.errors import InputError
from colift.base.text import read_bytes
from numpy.typing import NDArray

LARGEST: Final = 256 * 1024 * 1024
"""Largest file [bytes]: half an hour of 60 markers at 100 Hz as text."""

ENCODINGS: Final = (
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
    (codecs.BOM_UTF8, "utf-8-sig"),
)
"""Byte order marks and their encodings; that of UTF-32 begins with that of UTF-16."""

DELIMITERS: Final = ("\t", ";", "|", ",")
"""Marks between columns; the first that most lines have separates them, since a comma may be a
decimal sign where another mark is."""

UNSEEN: Final = frozenset(
    ("", "nan", "-nan", "na", "n/a", "#n/a", "null", "none", "-", "--", ".", "inf", "-inf", "nd")
    + ("-nan(ind)", "nan(ind)", "1.#qnan", "-1.#ind", "missing", "#num!", "#value!")
)
"""Texts, in lower case, for a value that was not measured."""

DECIMAL_COMMA: Final = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")
DECIMAL_POINT: Final = re.compile(r"[+-]?\d*\.\d+([eE][+-]?\d+)?")
THOUSANDS: Final = re.compile(r"[+-]?\d{1,3}([.,' ]\d{1,3})+([.,]\d+)?")


@dataclass(frozen=True)
class Line:
    """A line of a table."""

    number: int
    """Its number in the file."""
    cells: tuple[str, ...]
    """Its fields, without blanks around them."""

    def at(self, column: int) -> str:
        """Return a field; empty beyond the end of the line."""
        return self.cells[column] if column < len(self.cells) else ""

    @property
    def empty(self) -> bool:
        """Whether it has nothing but delimiters."""
        return not any(self.cells)


def text_in(path: Path) -> str:
    """Return the text of a file, as :func:`text_of`."""
    return text_of(read_bytes(path, LARGEST), str(path))


def text_of(data: bytes, where: str) -> str:
    r"""Return the text of a file in any usual encoding, each line ended by ``\n``.

    Without a mark it is UTF-8, UTF-16 if every other byte is 0, else Windows-1252 or Latin-1.

    Raises
    ------
    InputError
        If it is no text.
    """
    encoding = next((name for mark, name in ENCODINGS if data.startswith(mark)), "")
    start = data[:4096]
    if not encoding and b"\0" in start:
        wide = start[1::2].count(0), start[::2].count(0)
        encoding = (
            ("utf-16-le", "utf-16-be")[wide[0] < wide[1]] if max(wide) > len(start) // 4 else ""
        )
        if not encoding:
            raise InputError(f"{where}: this is no text, and no motion file that colift knows")
    for name in filter(None, (encoding, "utf-8" * (not encoding), "cp1252" * (not encoding))):
        try:
            text = data.decode(name)
            break
        except UnicodeDecodeError:
            continue
    else:
        if encoding:
            raise InputError(f"{where}: this is no text in {encoding.upper()}, though it begins so")
        text = data.decode("latin-1")
    if any(ord(c) < 32 and c not in "\t\n\f\r\x1a" for c in text[:4096]):
        raise InputError(f"{where}: this is no text, and no motion file that colift knows")
    return text.replace("\r\n", "\n").replace("\r", "\n").rstrip("\x1a")


def delimiter_of(lines: Sequence[str]) -> str:
    """Return the mark between the columns of a table; a blank if it is white space.

    Parameters
    ----------
    lines
        Some lines of its data.
    """
    filled = [line for line in lines if line.strip()]
    for mark in DELIMITERS:
        if sum(mark in line for line in filled) > len(filled) // 2:
            return mark
    return " "


def split_lines(text: str, delimiter: str, first: int = 1) -> list[Line]:
    """Return the lines of a table, without empty ones.

    Parameters
    ----------
    text
        The table.
    delimiter
        The mark between columns; a blank for any white space.
    first
        Number of the first line in the file.

    Raises
    ------
    ValueError
        If a quotation mark opens a field that does not end: it would hide the lines after it.
    """
    rows = text.split("\n")
    if delimiter == " ":
        found = (Line(i, tuple(row.split())) for i, row in enumerate(rows, first))
        return [line for line in found if line.cells]
    reader = csv.reader(rows, delimiter=delimiter)
    made: list[Line] = []
    start = 0
    try:
        for row in reader:
            if reader.line_num > start + 1:
                [*csv.reader(rows[start : reader.line_num], delimiter=delimiter, strict=True)]
            made.append(Line(first + start, tuple(cell.strip() for cell in row)))
            start = reader.line_num
    except csv.Error:
        raise ValueError(
            f"line {first + start}: a quotation mark opens a field that does not end"
        ) from None
    return [line for line in made if line.cells]


def decimal_sign(lines: Sequence[Line], delimiter: str) -> str:
    """Return the decimal sign of the numbers in a table: a point, or a comma."""
    if delimiter == ",":
        return "."
    commas = points = 0
    for line in lines[:200]:
        commas += sum(DECIMAL_COMMA.fullmatch(cell) is not None for cell in line.cells)
        points += sum(DECIMAL_POINT.fullmatch(cell) is not None for cell in line.cells)
    return "," if commas > points else "."


def numbers(
    lines: Sequence[Line], columns: Sequence[int], names: Sequence[str], decimal: str, where: str
) -> NDArray[np.float64]:
    """Return some columns of a table as numbers, NaN where nothing was measured.

    Parameters
    ----------
    lines
        Its lines of data.
    columns
        Indices of the columns, shape (k,).
    names
        Their names, for messages.
    decimal
        The decimal sign.
    where
        The file's name, for messages.

    Returns
    -------
    NDArray[np.float64]
        Shape (lines, k).

    Raises
    ------
    InputError
        If a field is no number; the message names its line and column.
    """
    texts = [
        "nan" if cell.lower() in UNSEEN else cell.replace(",", ".") if decimal == "," else cell
        for line in lines
        for cell in map(line.at, columns)
    ]
    try:
        values = np.array(texts, dtype=np.str_).astype(np.float64)
    except ValueError:
        cells = [line.at(column) for line in lines for column in columns]
        values = np.array(
            [
                _number(text, cell, lines[i // len(names)].number, names[i % len(names)], where)
                for i, (text, cell) in enumerate(zip(texts, cells, strict=True))
            ]
        )
    return values.reshape(len(lines), len(columns))


def _number(text: str, written: str, line: int, name: str, where: str) -> float:
    try:
        return float(text)
    except ValueError:
        hint = ""
        if THOUSANDS.fullmatch(written):
            hint = ": write it without separators of thousands, and with a decimal point, as 1234.5"
        raise InputError(
            f"{where}, line {line}: {name} is {written!r:.40}, must be a number{hint}"
        ) from None


def is_number(text: str) -> bool:
    """Return whether a field is a number, with either decimal sign."""
    try:
        float(text.replace(",", ".", 1))
    except ValueError:
        return False
    return text.lower() not in UNSEEN


def rate_in(text: str) -> float:
    """Return the rate [Hz] in a field, with either decimal sign; 0 if there is none."""
    return float(text.replace(",", ".", 1)) if is_number(text) else 0.0


def check_widths(lines: Sequence[Line], width: int, where: str) -> None:
    """Refuse lines of data with more fields than there are columns.

    Raises
    ------
    InputError
        At the first such line: usually a decimal comma between columns separated by commas, or a
        line that is no data.
    """
    for line in lines:
        if len(line.cells) > width and any(line.cells[width:]):
            raise InputError(
                f"{where}, line {line.number}: {len(line.cells)} fields, must be {width} as in the "
                "header (decimal commas between columns that are separated by commas? Export with "
                "decimal points, or with semicolons between the columns)"
            )
