"""The report as one HTML file that needs nothing else: images and style are in it."""

from base64 import b64encode
from collections.abc import Mapping, Sequence
from html import escape
from typing import Final

from ..rendering.page import cell, page, row
from ..rendering.page import table as html_table
from .claims import Claim
from .figures.picture import Picture
from .table_one import TableOne
from .words import (
    DEFINITIONS,
    HEADER,
    INTRODUCTION,
    TABLE_CAPTION,
    TITLE,
    table_notes,
    table_rows,
    verdict,
)

STYLE: Final = """
:root { --yes: #00694c; --no: #a33f00; }
@media (prefers-color-scheme: dark) { :root { --yes: #4cc79f; --no: #ff9a5c; }
  figure img { filter: invert(0.91) hue-rotate(180deg); } }
h3 { font-size: 1.02rem; margin: 0 0 0.5rem; }
tbody tr:last-child :is(th, td) { font-weight: 650; }
td small { font-weight: 400; }
figure { margin: 2rem 0 2.5rem; }
figure img { display: block; width: 100%; max-width: 52rem; height: auto; border-radius: 6px; }
figcaption { max-width: 46rem; margin-top: 0.6rem; }
.claims { list-style: none; counter-reset: claim; padding: 0; margin: 1rem 0; }
.claims li { counter-increment: claim; background: var(--card); border-radius: 8px; max-width: none;
  padding: 0.9rem 1.1rem; margin: 0.7rem 0; border-left: 4px solid var(--yes); }
.claims li.no { border-left-color: var(--no); }
.claims h3::before { content: counter(claim) ". "; color: var(--faint); }
.mark { font-size: 0.8rem; font-weight: 650; color: var(--yes); white-space: nowrap; }
.no .mark { color: var(--no); }
dl { display: grid; grid-template-columns: 6rem 1fr; gap: 0.15rem 0.8rem; margin: 0;
  font-size: 0.92rem; }
dt { color: var(--faint); }
dd { margin: 0; }
@media (max-width: 36rem) { dl { grid-template-columns: 1fr; } dt { margin-top: 0.35rem; } }
"""
"""What the report needs beside the common style."""


def html_page(
    table: TableOne,
    pictures: Sequence[Picture],
    drawn: Mapping[str, bytes],
    claims: Sequence[Claim],
    provenance: str,
) -> str:
    """Return the report as HTML.

    Parameters
    ----------
    table, pictures, claims
        What the report shows.
    drawn
        Each picture as PNG, by name.
    provenance
        What the report was made from, in one line.
    """
    first, *figures = (_picture(picture, drawn[picture.name]) for picture in pictures)
    scores = html_table(HEADER, [_cells(*told) for told in table_rows(table)])
    notes = "".join(f"<p>{escape(note)}</p>" for note in table_notes(table))
    definitions = "".join(f"<li>{escape(text)}</li>" for text in DEFINITIONS)
    items = "".join(_claim(claim) for claim in claims)
    count = verdict(sum(claim.holds for claim in claims), len(claims))
    body = f"""
<h1>{escape(TITLE)}</h1>
<p>{escape(INTRODUCTION)}</p>
<p class="faint">{escape(provenance)}</p>
<h2>Table I</h2>
<p class="faint">{escape(TABLE_CAPTION)}</p>
{scores}
{notes}
{first}
<h2>The paper's claims</h2>
<p>{escape(count)}</p>
<ol class="claims">{items}</ol>
<h2>Figures</h2>
{"".join(figures)}
<h2>Definitions</h2>
<ul>{definitions}</ul>
"""
    return page(TITLE, body, style=STYLE)


def _cells(name: str, *values: str) -> str:
    """Return a row of the table; what is in brackets, an interval, goes under its value."""
    parts = (value.partition(" (") for value in values)
    return row(name, [cell(mean, bracket.strip() + rest) for mean, bracket, rest in parts])


def _claim(claim: Claim) -> str:
    rows = [
        ("Paper", f"{claim.paper} ({claim.figure})"),
        ("Holds if", claim.criterion),
        ("Measured", claim.measured),
    ]
    if claim.note:
        rows.append(("Note", claim.note))
    told = "".join(f"<dt>{name}</dt><dd>{escape(text)}</dd>" for name, text in rows)
    mark, kind = ("holds", "yes") if claim.holds else ("does not hold", "no")
    return (
        f'<li class="{kind}"><h3>{escape(claim.claim)} <span class="mark">{mark}</span></h3>'
        f"<dl>{told}</dl></li>"
    )


def _picture(picture: Picture, png: bytes) -> str:
    data = b64encode(png).decode("ascii")
    return (
        f'<figure id="{picture.name}"><h3>{escape(picture.title)}</h3>'
        f'<img alt="{escape(picture.title)}" src="data:image/png;base64,{data}">'
        f"<figcaption>{escape(picture.caption)} Data: {picture.name}.csv.</figcaption></figure>"
    )
