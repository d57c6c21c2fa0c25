"""``colift paper``: the paper's results, reproduced."""

import json
import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from ..benchmark.executors import local_pool
from .executors import Jobs
from .progress import progress_bar
from .seeds import seed_range


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
    from ..benchmark.paper.report import check_target, claims_json, make_report, write_report
    from ..benchmark.suite import make_suite
    from .paper_summary import summary_table

    suite = make_suite("paper-v1").with_seeds(*seed_range(seeds))
    effort = Effort(learning_trials=trials)
    check_target(out)
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
        console = Console()
        for table in summary_table(report):
            console.print(table)
        console.print(f"Report: {out / 'report.html'}", highlight=False, soft_wrap=True)
