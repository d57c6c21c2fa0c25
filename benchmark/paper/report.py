"""The report: tables, figures and claims from the evidence, and its files."""

import csv
import dataclasses
import io
import json
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any, Final

from ...agents.errors import InputError
from .claims import Claim, all_claims
from .evidence import Evidence
from .figures.all import all_pictures
from .figures.picture import Picture
from .html import html_page
from .markdown import markdown_page
from .table_one import TableOne, table_one

PAGES: Final = ("report.html", "report.md", "claims.json")
"""The files of a report beside the figures, each a PNG and a CSV."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Report:
    """Everything that the pages show."""

    table: TableOne
    pictures: list[Picture]
    claims: list[Claim]
    provenance: str
    """What the report was made from, in one line."""


def make_report(evidence: Evidence) -> Report:
    """Return the report of the evidence."""
    table = table_one(evidence.reactive, evidence.blend, evidence.team)
    suite = evidence.blend.suite
    return Report(
        table=table,
        pictures=all_pictures(evidence, table),
        claims=all_claims(evidence, table),
        provenance=f"colift {version('colift')}, suite {suite.name}, digest {suite.digest}, "
        f"seeds {suite.seeds[0]} to {suite.seeds[-1]}, {table.lifts} lifts a subject and case",
    )


def claims_json(report: Report) -> list[dict[str, Any]]:
    """Return the claims as ``claims.json`` holds them."""
    return [dataclasses.asdict(claim) for claim in report.claims]


def check_target(folder: Path) -> None:
    """Refuse a folder that the report cannot be written to, before any work is done.

    Raises
    ------
    InputError
        If it is a file, or cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"--out {folder} cannot be a folder: {error}") from error


def write_report(report: Report, folder: Path) -> None:
    """Write the report into a folder: pages, claims, and a PNG and a CSV for each figure."""
    folder.mkdir(parents=True, exist_ok=True)
    drawn = {picture.name: _png(picture) for picture in report.pictures}
    for picture in report.pictures:
        (folder / f"{picture.name}.png").write_bytes(drawn[picture.name])
        _write_csv(folder / f"{picture.name}.csv", picture)
    pages = (
        html_page(report.table, report.pictures, drawn, report.claims, report.provenance),
        markdown_page(report.table, report.pictures, report.claims, report.provenance),
        json.dumps(claims_json(report), indent=2, allow_nan=False, ensure_ascii=False) + "\n",
    )
    for name, content in zip(PAGES, pages, strict=True):
        (folder / name).write_text(content, encoding="utf-8")


def _png(picture: Picture) -> bytes:
    buffer = io.BytesIO()
    # Without the library's name and version in it, the same data give the same file.
    picture.figure.savefig(buffer, format="png", metadata={"Software": None})
    return buffer.getvalue()


def _write_csv(path: Path, picture: Picture) -> None:
    """Write the columns; those that end early, and missing values, leave their cells empty."""
    columns = picture.columns
    length = max(len(values) for values in columns.values())
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for row in range(length):
            writer.writerow(
                _cell(values[row]) if row < len(values) else "" for values in columns.values()
            )


def _cell(value: float | str) -> float | str:
    return "" if value != value else value
