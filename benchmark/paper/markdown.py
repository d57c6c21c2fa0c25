"""The report as Markdown, with the figures as PNG files beside it."""

from collections.abc import Sequence

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


def markdown_page(
    table: TableOne, pictures: Sequence[Picture], claims: Sequence[Claim], provenance: str
) -> str:
    """Return the report as Markdown."""
    first, *figures = pictures
    blocks = [
        f"# {TITLE}",
        INTRODUCTION,
        provenance,
        "## Table I",
        TABLE_CAPTION,
        _table(HEADER, table_rows(table)),
        *table_notes(table),
        _picture(first),
        "## The paper's claims",
        verdict(sum(claim.holds for claim in claims), len(claims)),
        *[_claim(number, claim) for number, claim in enumerate(claims, 1)],
        "## Figures",
        *[_picture(picture) for picture in figures],
        "## Definitions",
        "\n".join(f"- {definition}" for definition in DEFINITIONS),
    ]
    return "\n\n".join(blocks) + "\n"


def _table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [header, ["---", *["---:"] * (len(header) - 1)], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def _claim(number: int, claim: Claim) -> str:
    lines = [
        f"### {number}. {claim.claim} — {'holds' if claim.holds else 'does not hold'}",
        f"- Paper: {claim.paper} ({claim.figure})",
        f"- Holds if: {claim.criterion}",
        f"- Measured: {claim.measured}",
    ]
    if claim.note:
        lines.append(f"- Note: {claim.note}")
    return "\n".join((lines[0], "", *lines[1:]))


def _picture(picture: Picture) -> str:
    name = picture.name
    return (
        f"### {picture.title}\n\n![{picture.title}]({name}.png)\n\n{picture.caption} "
        f"Data: [{name}.csv]({name}.csv)"
    )
