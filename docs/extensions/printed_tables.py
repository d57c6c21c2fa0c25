"""Outputs of commands, read back: tables by the gaps that all of their lines share."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from colift.benchmark.figures.making import COLUMNS

RULE: Final = re.compile(r" ─{3,}")
"""The line under a table's head."""

GAP: Final = re.compile(r"(?<=x) {2,}(?=x)")
"""Blanks, in all lines of a table at once, between two columns."""

NAME: Final = re.compile(r"\S+,")
"""A name that goes on in the next line: its parts are joined without a blank."""

NUMBER: Final = re.compile(r"(?!.*[A-Za-z]{3})[<>]? ?[-+]?\d.*|none|")
"""A cell of a column of numbers."""

DEEPER: Final = "    "
"""Begin of a line whose name is set in under the one above it."""

INDENT: Final = "\N{EM SPACE}"


@dataclass(frozen=True, kw_only=True)
class PrintedTable:
    """A table of an output."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    @property
    def numeric(self) -> tuple[bool, ...]:
        """Whether a column has numbers alone."""
        return tuple(all(map(NUMBER.fullmatch, column)) for column in zip(*self.rows, strict=True))


def read_output(text: str) -> Iterator[str | PrintedTable]:
    """Yield the paragraphs and tables of an output, in order; a paragraph is one line.

    Raises
    ------
    ValueError
        If a table begins with a line that fills at most half of its columns.
    """
    words: list[str] = []
    lines = text.splitlines()
    place = 0
    while place < len(lines):
        rule = _rule_below(lines, place)
        if rule is None:
            words.append(lines[place])
            place += 1
            continue
        yield from _paragraphs(words)
        words = []
        end = rule + 1
        while end < len(lines) and (lines[end][:1] == " " or _goes_on(lines, end)):
            end += 1
        body = [line for line in lines[rule + 1 : end] if line.strip()]
        yield _table(lines[place:rule], body)
        place = end
    yield from _paragraphs(words)


def _rule_below(lines: Sequence[str], place: int) -> int | None:
    """Return the place of the rule under a head of one or two lines, if it begins here."""
    for at in (place + 1, place + 2):
        head = lines[place:at]
        if at < len(lines) and RULE.match(lines[at]) and all(line[:1] == " " for line in head):
            return at
    return None


def _goes_on(lines: Sequence[str], place: int) -> bool:
    """Return whether an empty line only separates two rows of the same table."""
    row = not lines[place] and "".join(lines[place + 1 : place + 2]).startswith(" ")
    return row and _rule_below(lines, place + 1) is None


def _paragraphs(lines: Sequence[str]) -> Iterator[str]:
    """Yield the sentences of folded lines: a line goes on if the next word had no place in it."""
    paragraph = last = ""
    for line in (*map(str.strip, lines), ""):
        full = len(last) + len(line.partition(" ")[0]) >= COLUMNS or line.startswith("(")
        if paragraph and not (line and last and full):
            yield paragraph
            paragraph = ""
        paragraph = f"{paragraph} {line}".strip()
        last = line


def _table(head: Sequence[str], body: Sequence[str]) -> PrintedTable:
    """Return the table of a head and the lines under its rule.

    A line that fills at most half of the columns continues the row above it. A column without a
    head belongs to the one before it.
    """
    width = max(map(len, (*head, *body)))
    lines = [line.ljust(width) for line in (*head, *body)]
    used = "".join(" " if set(column) == {" "} else "x" for column in zip(*lines, strict=True))
    starts = [0, *(gap.end() for gap in GAP.finditer(used))]
    ends = [*starts[1:], width]
    cells = [[line[a:b].strip() for a, b in zip(starts, ends, strict=True)] for line in lines]
    for line, row in zip(lines, cells, strict=True):
        if line.startswith(DEEPER) and not NUMBER.fullmatch(row[0]):
            row[0] = INDENT + row[0]
    names = [" ".join(filter(None, column)) for column in zip(*cells[: len(head)], strict=True)]
    rows: list[list[str]] = []
    for row in cells[len(head) :]:
        if 2 * sum(map(bool, row)) > len(row):
            rows.append(row)
        elif rows:
            rows[-1] = [_joined(*pair) for pair in zip(rows[-1], row, strict=True)]
        else:
            raise ValueError(f"a table begins with the line {row}")
    for place in range(len(names) - 1, 0, -1):
        if not names[place]:
            for row in (names, *rows):
                row[place - 1 : place + 1] = [_joined(row[place - 1], row[place])]
    return PrintedTable(head=tuple(names), rows=tuple(map(tuple, rows)))


def _joined(first: str, second: str) -> str:
    return f"{first}{'' if NAME.fullmatch(first) else ' '}{second}".strip()
