"""Tables and text on stdout, without trailing blanks."""

import io
import os
from collections.abc import Iterable, Iterator, Sequence
from typing import Final

from rich import box
from rich.console import Console, RenderableType
from rich.measure import Measurement
from rich.segment import Segment, Segments
from rich.table import Column, Table
from rich.text import Text

Cell = str | Text

WIDEST: Final = 10_000
"""More columns than any table has [characters]."""

COLUMNS: Final = 100
"""Columns of tables as text."""

UNBROKEN: Final = 18
"""Longest word of a table that stays whole where the terminal is too narrow."""


def table(
    title: str,
    columns: Sequence[str | Column],
    rows: Iterable[Sequence[Cell] | None],
    *,
    caption: str = "",
) -> Table:
    """Return a table, to be printed by :func:`show`.

    Parameters
    ----------
    title, caption
        The lines above and below it; empty for none.
    columns
        Titles: the first column is aligned left, the others right, on one line each. Any other
        column is given as a Rich column.
    rows
        The cells of each row, text without markup; None draws a line.
    """
    made = Table(
        *(_column(each, first=i == 0) for i, each in enumerate(columns)),
        title=Text(title) if title else None,
        caption=Text(caption) if caption else None,
        title_justify="left",
        caption_justify="left",
        box=box.SIMPLE_HEAD,
        padding=(0, 0, 0, 1),
    )
    for row in rows:
        if row is None:
            made.add_section()
        else:
            made.add_row(*(Text(cell) if isinstance(cell, str) else cell for cell in row))
    for column in made.columns:
        if column.overflow == "fold":
            column.min_width = max(column.min_width or 0, min(_longest_word(column), UNBROKEN))
    return made


def left(title: str) -> Column:
    """Return a column aligned left, whose cells take as many lines as they need."""
    return Column(title, overflow="fold")


def styled(cells: Sequence[Cell], style: str) -> list[Cell]:
    """Return the cells of a row in a style, such as ``bold``."""
    return [Text(str(cell), style) for cell in cells]


def optional_number(value: float | None, digits: str) -> str:
    """Return a number in a format such as ``.2f``, or ``none``."""
    return "none" if value is None else format(value, digits)


def stdout_console() -> Console:
    """Return the console of stdout, as wide as its terminal, or as the variable ``COLUMNS`` asks.

    A file or a pipe has no width: lines are not wrapped there, so that a program finds them whole.
    """
    console = Console()
    if not console.is_terminal and "COLUMNS" not in os.environ:
        console.width = WIDEST
    return console


def show(*parts: RenderableType, console: Console | None = None) -> None:
    """Print tables and texts without trailing blanks; a caption is as wide as the terminal.

    A table that does not fit is wider than the terminal: no column is left out.

    Parameters
    ----------
    parts
        Each begins on a new line. A string is text without markup.
    console
        Destination; None is :func:`stdout_console`.
    """
    shown = console or stdout_console()
    for part in parts:
        for each in _separate(part):
            options = shown.options
            if isinstance(each, Table):
                options = options.update(width=max(options.max_width, _least_width(each, shown)))
            lines = map(_stripped, shown.render_lines(each, options, pad=False))
            segments = [segment for line in lines for segment in (*line, Segment.line())]
            shown.print(Segments(segments), end="", soft_wrap=True)


def text_of(*parts: RenderableType) -> str:
    """Return what :func:`show` prints, :data:`COLUMNS` wide and without colours."""
    # In Jupyter a console would show the text in the cell instead of writing it to its file.
    file = io.StringIO()
    console = Console(file=file, width=COLUMNS, no_color=True, force_jupyter=False, _environ={})
    show(*parts, console=console)
    return file.getvalue().strip("\n")


def counted(number: int, noun: str) -> str:
    """Return a number of things, such as '1 lift' or '3 lifts'; the noun is given in singular."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def _column(column: str | Column, *, first: bool) -> Column:
    if isinstance(column, Column):
        return column
    return left(column) if first else Column(column, justify="right", no_wrap=True)


def _lines(column: Column) -> list[str]:
    """Return the lines of a column's cells and of its title."""
    return [line for cell in (column.header, *column.cells) for line in str(cell).splitlines()]


def _longest_word(column: Column) -> int:
    return max((len(word) for line in _lines(column) for word in line.split()), default=0)


def _least_width(made: Table, console: Console) -> int:
    """Return the least width at which a table shows all columns, with those that wrap at theirs."""
    longest = [max(map(len, _lines(column)), default=0) for column in made.columns]
    wide = console.options.update(width=WIDEST)
    between = Measurement.get(console, wide, made).maximum - sum(longest)
    return between + sum(
        line if column.no_wrap else min(column.min_width or UNBROKEN, line)
        for column, line in zip(made.columns, longest, strict=True)
    )


def _separate(part: RenderableType) -> Iterator[RenderableType]:
    """Yield a part; a table's caption separately, since Rich would wrap it at the table's width."""
    if isinstance(part, str):
        yield Text(part)
        return
    if not isinstance(part, Table) or part.caption is None:
        yield part
        return
    caption, part.caption = part.caption, None
    yield part
    yield Text(str(caption), "dim italic")
    yield Text("")


def _stripped(line: Sequence[Segment]) -> list[Segment]:
    """Return a line without the blanks at its end."""
    kept = list(line)
    while kept and not kept[-1].text.strip():
        kept.pop()
    if kept:
        kept[-1] = Segment(kept[-1].text.rstrip(), kept[-1].style)
    return kept
