"""``colift paper``: reproduction of the paper's results."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer
from colift.benchmark.execution.progress import workers
from colift.benchmark.rendering.layout import PAGE
from colift.benchmark.tables.printing import left, show, table
from colift.cli.document import print_json
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import AsJson, Jobs, LayoutName, chosen_layout, seed_range, try_folder
from colift.cli.remedies import naming
from rich.console import RenderableType

if TYPE_CHECKING:
    from colift.benchmark.paper.report import Report

SHOWN: Final = (0, 1, 2, 4, 5, 8)
"""Columns of Table I that fit a terminal: not the ratios and the differences."""


def paper(
    out: Annotated[
        Path,
        typer.Option(metavar="DIR", help="Folder for the report; its page is report.html."),
    ] = Path("paper"),
    seeds: Annotated[
        str, typer.Option(metavar="A:B", help="Seeds A to B-1, for each subject.")
    ] = "1000:1020",
    jobs: Jobs = None,
    trials: Annotated[int, typer.Option(metavar="N", help="Learning trials.", min=1)] = 60,
    blend: Annotated[
        str,
        typer.Option(
            metavar="NAME=VALUE,...",
            help="Parameters of blend, from 'colift list blend', such as forgetting=0.95.",
        ),
    ] = "",
    layout: LayoutName = PAGE.name,
    as_json: AsJson = False,
) -> None:
    """Reproduce the paper: Table I, figures 4 to 9 and its claims, beside the published values.

    Example: colift paper --seeds 4000:4010 --trials 20 --out paper
    """
    # The report needs matplotlib, which is slow to load.
    from colift.benchmark.paper.evidence import (
        Effort,
        blend_parameters,
        collect_evidence,
        lift_count,
    )
    from colift.benchmark.paper.report import claims_json, make_report, write_report
    from colift.benchmark.suites.suite import make_suite

    suite = make_suite("paper-v1").with_seeds(*seed_range(seeds))
    effort = Effort(learning_trials=trials)
    with naming("--blend"):
        blend_parameters(blend)
    size = chosen_layout(layout)
    try_folder("--out", out)
    with (
        reported_interrupt("no report was written"),
        workers("paper", lift_count(suite, effort), jobs) as (pool, progress),
    ):
        evidence = collect_evidence(suite, effort, blend=blend, executor=pool, progress=progress)
    report = make_report(evidence, size)
    write_report(report, out)
    if as_json:
        print_json(claims_json(report))
    else:
        show(*_summary(report))
        print(f"Report: {out / 'report.html'}")


def _summary(report: "Report") -> list[RenderableType]:
    """Return Table I, its means at two latencies, and the list of the claims."""
    from colift.benchmark.paper.pages import (
        HEADER,
        LATENCY_CAPTION,
        LATENCY_HEADER,
        claims_verdict,
        kind,
        latency_rows,
        table_notes,
        table_rows,
    )

    titles = [HEADER[column].replace(": ", ":\n") for column in SHOWN]
    rows = [
        [row[column].replace(" (", "\n(") for column in SHOWN] for row in table_rows(report.table)
    ]
    claims = table(
        claims_verdict(report.claims),
        ("claim", left("measured"), "kind", "holds"),
        (
            (each.claim, each.measured, kind(each), "yes" if each.holds else "no")
            for each in report.claims
        ),
    )
    latency = table(
        "The age of the sample",
        LATENCY_HEADER,
        latency_rows(report.table, report.fresh),
        caption=LATENCY_CAPTION,
    )
    return [table("Table I: RMSE [mm]", titles, rows), *table_notes(report.table), latency, claims]
