"""The report on the paper, as a person reads it in a terminal."""

from typing import Final

from rich import box
from rich.console import RenderableType
from rich.table import Table

from ..benchmark.paper.report import Report
from ..benchmark.paper.words import HEADER, table_notes, table_rows, verdict

SHOWN: Final = (0, 1, 2, 4, 5, 8)
"""Columns of Table I that fit a terminal: not the ratios and the differences."""


def summary_table(report: Report) -> list[RenderableType]:
    """Return Table I and the list of the claims."""
    table = Table(
        title="Table I: RMSE [mm]", title_justify="left", box=box.SIMPLE_HEAD, padding=(0, 0, 0, 1)
    )
    for column in SHOWN:
        heading = HEADER[column].replace(": ", ":\n")
        table.add_column(heading, justify="right" if column else "left", no_wrap=True)
    for row in table_rows(report.table):
        table.add_row(*(row[column].replace(" (", "\n(") for column in SHOWN))
    claims = Table(
        title=verdict(sum(claim.holds for claim in report.claims), len(report.claims)),
        title_justify="left",
        box=box.SIMPLE_HEAD,
    )
    claims.add_column("claim")
    claims.add_column("measured")
    claims.add_column("holds")
    for claim in report.claims:
        claims.add_row(claim.claim, claim.measured, "yes" if claim.holds else "no")
    return [table, *table_notes(report.table), claims]
