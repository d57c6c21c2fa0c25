"""The report as one HTML file that needs nothing else, and as Markdown with its figures beside."""

from base64 import b64encode
from collections.abc import Mapping, Sequence

from ..rendering.page import Cell, Row, render
from . import words
from .exhibits import Claim, Picture
from .table_one import TableOne


def report_pages(
    table: TableOne,
    pictures: Sequence[Picture],
    drawn: Mapping[str, bytes],
    claims: Sequence[Claim],
    provenance: str,
) -> tuple[str, str]:
    """Return the report as HTML and as Markdown.

    Parameters
    ----------
    table, pictures, claims
        What the report shows.
    drawn
        Each picture as PNG, by name.
    provenance
        What the report was made from, in one line.
    """
    lines = words.table_rows(table)
    content = {
        "title": words.TITLE,
        "words": words,
        "provenance": provenance,
        "lines": lines,
        "rows": [_row(*line) for line in lines],
        "notes": words.table_notes(table),
        "pictures": pictures,
        "drawn": {name: b64encode(png).decode("ascii") for name, png in drawn.items()},
        "claims": claims,
        "verdict": words.verdict(sum(claim.holds for claim in claims), len(claims)),
    }
    html, markdown = (render(__package__, f"report.{kind}", **content) for kind in ("html", "md"))
    return html, markdown


def _row(name: str, *values: str) -> Row:
    """Return a row of the table; what is in brackets, an interval, goes under its value."""
    parts = (value.partition(" (") for value in values)
    return Row(name, [Cell(mean, bracket.strip() + rest) for mean, bracket, rest in parts])
