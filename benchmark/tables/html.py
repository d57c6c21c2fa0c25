"""Tables of a terminal as HTML for notebooks, light or dark."""

from collections.abc import Iterator
from typing import Final

from markupsafe import Markup, escape
from rich.table import Table
from rich.text import Text

PLAIN: Final = "background: transparent; border-collapse: collapse; margin: 0.8em 0 0.2em"
LINE: Final = "border-bottom: 1px solid color-mix(in srgb, currentColor 25%, transparent)"
NEWLINE: Final = "\n"
LINES: Final = "white-space: pre-wrap; max-width: 60em"
SMALL: Final = "margin: 0 0 1em; font-size: 85%; opacity: 0.75; max-width: 60em"


def table_html(made: Table) -> Markup:
    """Return a table in the colours of the text around it.

    A row in bold stays bold; rows in a colour, such as those of two people, are italic.
    """
    sides = [column.justify or "left" for column in made.columns]
    heads = [escape(str(column.header)) for column in made.columns]
    rows = zip(*(column.cells for column in made.columns), strict=True)
    body = "\n".join(_row([*map(_content, cells)], sides, "td") for cells in rows)
    title = f"<caption style='caption-side: top; text-align: left'>{escape(str(made.title))}"
    note = f"<p style='{SMALL}'>{escape(str(made.caption))}</p>" if made.caption else ""
    return Markup(
        f"<table style='{PLAIN}'>{title}</caption>\n"
        f"<thead>{_row(heads, sides, 'th')}</thead>\n<tbody>{body}</tbody></table>{note}"
    )


def lines_html(*lines: str) -> Markup:
    """Return lines of text as a paragraph that keeps their blanks."""
    return Markup(
        f"<p style='white-space: pre-wrap; max-width: 60em'>{escape(NEWLINE.join(lines))}</p>"
    )


def _row(cells: list[str], sides: list[str], kind: str) -> str:
    inner = "".join(
        f"<{kind} style='text-align: {side}; {LINE}'>{cell}</{kind}>"
        for cell, side in zip(cells, sides, strict=True)
    )
    return f"<tr style='background: transparent'>{inner}</tr>"


def _content(cell: object) -> str:
    """Return the text of a cell with its style."""
    text = "<br>".join(_broken(str(cell)))
    style = str(cell.style) if isinstance(cell, Text) else ""
    if "bold" in style:
        return f"<strong>{text}</strong>"
    return f"<em>{text}</em>" if style else text


def _broken(text: str) -> Iterator[str]:
    yield from (str(escape(line)) for line in text.splitlines() or [""])
