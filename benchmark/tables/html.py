"""Tables and texts of a terminal as HTML for notebooks, light or dark."""

from collections.abc import Sequence
from itertools import chain, groupby
from typing import Final

from markupsafe import Markup, escape
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

PLAIN: Final = "background: transparent; border-collapse: collapse; margin: 0.8em 0 0.2em"
TITLE: Final = "caption-side: top; text-align: left"
LINE: Final = "border-bottom: 1px solid color-mix(in srgb, currentColor 25%, transparent)"
SMALL: Final = "margin: 0 0 1em; font-size: 85%; opacity: 0.75; max-width: 60em"
LINES: Final = "white-space: pre-wrap; max-width: 60em"


def html_of(*parts: RenderableType) -> Markup:
    """Return tables and texts as elements in the colours of the text around them.

    A row in bold stays bold; rows in a colour, such as those of two people, are italic. Texts that
    follow each other are one paragraph, which keeps their blanks.
    """
    groups = groupby(parts, key=lambda part: isinstance(part, Table))
    found = (map(_table, group) if tables else [_lines(*group)] for tables, group in groups)
    return Markup("\n").join(chain.from_iterable(found))


def _lines(*parts: RenderableType) -> Markup:
    text = "\n".join(map(str, parts))
    return Markup(f"<p style='{LINES}'>{escape(text)}</p>")


def _table(made: RenderableType) -> Markup:
    assert isinstance(made, Table)
    sides = [column.justify for column in made.columns]
    heads = [_content(str(column.header)) for column in made.columns]
    rows = zip(*(column.cells for column in made.columns), strict=True)
    body = "\n".join(_row([*map(_content, cells)], sides, "td") for cells in rows)
    title = f"<caption style='{TITLE}'>{escape(str(made.title))}</caption>" if made.title else ""
    note = f"<p style='{SMALL}'>{escape(str(made.caption))}</p>" if made.caption else ""
    return Markup(
        f"<table style='{PLAIN}'>{title}\n<thead>{_row(heads, sides, 'th')}</thead>\n"
        f"<tbody>{body}</tbody></table>{note}"
    )


def _row(cells: Sequence[str], sides: Sequence[str], kind: str) -> str:
    inner = "".join(
        f"<{kind} style='text-align: {side}; {LINE}'>{cell}</{kind}>"
        for cell, side in zip(cells, sides, strict=True)
    )
    return f"<tr style='background: transparent'>{inner}</tr>"


def _content(cell: object) -> str:
    """Return the text of a cell with its style."""
    text = "<br>".join(str(escape(line)) for line in str(cell).splitlines())
    style = str(cell.style) if isinstance(cell, Text) else ""
    if "bold" in style:
        return f"<strong>{text}</strong>"
    return f"<em>{text}</em>" if style else text
