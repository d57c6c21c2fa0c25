"""``colift submit``: put a submission on a board, and see what comes of it."""

import sys
from pathlib import Path
from typing import Annotated

import typer

from ..agents.submissions.submission import open_submission
from ..benchmark.execution.pool import checked_jobs
from .check import all_checks
from .options import Jobs
from .printing import argument, show
from .submit_here import Here
from .submit_there import There
from .tables.row import Outcome, row_table, standing


def submit_policy(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="The submission's folder.")],
    board: Annotated[
        str,
        typer.Option(
            metavar="PATH|URL",
            help="The board's folder, made if there is none; or its address, https://...",
        ),
    ],
    suite: Annotated[
        str | None,
        typer.Option(help="Suite that the board must have; a new one has standard-v1 by default."),
    ] = None,
    jobs: Jobs = None,
    token: Annotated[
        str, typer.Option(envvar="COLIFT_TOKEN", help="For a board on the web: who you are.")
    ] = "",
) -> None:
    """Put a submission on a board: public and hidden lifts, audit, replay, and a row.

    A board in a folder evaluates it here and at once, one on the web when its turn has come.
    """
    count = checked_jobs(jobs)
    opened = open_submission(folder)
    if board.startswith(("http://", "https://")):
        there = There.open(board, token)
        _check(folder, count)
        _tell(there.submitted(opened), folder)
        return
    here = Here.open(Path(board), suite)
    try:
        if here.known(opened):
            print(f"This content (digest {opened.digest}) is on the board already.")
        else:
            _check(folder, count)
        _tell(here.submitted(opened, count), folder)
    finally:
        here.close()


def _check(folder: Path, jobs: int) -> None:
    """Leave with the reason if the submission fails a check."""
    for each in all_checks(folder, None, False, jobs):
        if not each.ok:
            print(f"not submitted, its check fails: {each.name}: {each.told}", file=sys.stderr)
            print(f"Mend it, then: colift check {argument(folder)}", file=sys.stderr)
            raise typer.Exit(1)


def _tell(outcome: Outcome, folder: Path) -> None:
    """Print the row, or leave with the reason why there is none."""
    if outcome.row is None:
        print(outcome.reason, file=sys.stderr)
        if outcome.mend:
            print(f"Mend it, then: colift check {argument(folder)}", file=sys.stderr)
        raise typer.Exit(1)
    show(row_table(outcome.row), standing(outcome.row, outcome.ranking, outcome.section))
    print(outcome.next)
