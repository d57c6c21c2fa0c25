"""``colift paper``: the paper's results, reproduced."""

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer
from rich.console import RenderableType

from ..benchmark.execution.pool import local_pool
from .options import Jobs, check_folder, seed_range
from .printing import left, show, table
from .progress import progress_bar

if TYPE_CHECKING:
    from ..benchmark.paper.report import Report

SHOWN: Final = (0, 1, 2, 4, 5, 8)
"""Columns of Table I that fit a terminal: not the ratios and the differences."""


def paper(
    out: Annotated[
        Path,
        typer.Option(metavar="DIR", help="Where to write the report; report.html is its page."),
    ] = Path("paper"),
    seeds: Annotated[
        str, typer.Option(metavar="A:B", help="Seeds A to B-1 for each subject.")
    ] = "1000:1020",
    jobs: Jobs = None,
    trials: Annotated[int, typer.Option(metavar="N", help="Learning trials.", min=1)] = 60,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print claims.json alone, and nothing else.")
    ] = False,
) -> None:
    """Reproduce the paper: Table I, figures 4 to 9 and its claims, side by side with ours."""
    # The report needs matplotlib, which is slow to load: not for the other commands.
    from ..benchmark.paper.evidence import Effort, amount, gather
    from ..benchmark.paper.report import claims_json, make_report, write_report
    from ..benchmark.suites.suite import make_suite

    suite = make_suite("paper-v1").with_seeds(*seed_range(seeds))
    effort = Effort(learning_trials=trials)
    check_folder("--out", out)
    try:
        with (
            local_pool(jobs) as pool,
            progress_bar("paper", amount(suite, effort)) as progress,
        ):
            evidence = gather(suite, effort, executor=pool, progress=progress)
    except KeyboardInterrupt:
        print("interrupted: no report was written", file=sys.stderr)
        raise typer.Exit(1) from None
    report = make_report(evidence)
    write_report(report, out)
    if as_json:
        print(json.dumps(claims_json(report), indent=2, allow_nan=False))
    else:
        show(*_summary(report))
        print(f"Report: {out / 'report.html'}")


def _summary(report: "Report") -> list[RenderableType]:
    """Return Table I and the list of the claims."""
    from ..benchmark.paper.words import HEADER, table_notes, table_rows, verdict

    titles = [HEADER[column].replace(": ", ":\n") for column in SHOWN]
    rows = [
        [row[column].replace(" (", "\n(") for column in SHOWN] for row in table_rows(report.table)
    ]
    claims = table(
        verdict(sum(claim.holds for claim in report.claims), len(report.claims)),
        ("claim", left("measured"), "holds"),
        ((each.claim, each.measured, "yes" if each.holds else "no") for each in report.claims),
    )
    return [table("Table I: RMSE [mm]", titles, rows), *table_notes(report.table), claims]
