"""``colift submit``: put a submission on a board, and evaluate it there at once."""

import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from ..agents.errors import EvaluatorFault
from ..agents.submissions.submission import Submission, open_submission
from ..benchmark.executors import default_jobs, local_pool
from ..leaderboard.board import Board
from ..leaderboard.entry import Entry
from ..leaderboard.evaluation import Watch
from ..leaderboard.submitting import enter, work
from .check import all_checks
from .progress import stage_bar
from .row_table import row_table, standing


def submit(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="The submission's folder.")],
    board: Annotated[
        Path, typer.Option(metavar="PATH", help="The board's folder; made if there is none.")
    ],
    suite: Annotated[
        str | None,
        typer.Option(help="Suite that the board must have; a new one has standard-v1 by default."),
    ] = None,
    jobs: Annotated[
        int | None, typer.Option(metavar="N", help="Worker processes; default: all cores.")
    ] = None,
) -> None:
    """Put a submission on a board and evaluate it there: public and hidden lifts, audit, replay."""
    count = default_jobs() if jobs is None else jobs
    opened, place = open_submission(folder), Board.open(board, suite)
    season, digest = place.season.name, opened.contents.digest
    entry = place.entry(season, digest)
    if entry is None:
        _check(folder, count)
        entry = _evaluated(place, place.keep(opened.folder), count)
    else:
        print(f"This content (digest {opened.digest}) is on the board already.")
    if entry.row is None:
        print(
            f"refused, so there is no row: {entry.refusal}\n"
            f"Its public run: {place.bundle(season, digest)}\n"
            f"Mend it, then: colift check {folder}",
            file=sys.stderr,
        )
        raise typer.Exit(1)
    console = Console()
    console.print(row_table(entry.row))
    console.print(standing(entry.row, place.ranking(season)), highlight=False, soft_wrap=True)
    bundle = place.bundle(season, digest)
    print(f"Bundle of the public run: {bundle}\nNext: colift verify {bundle}")


def _check(folder: Path, jobs: int) -> None:
    """Leave with the reason if the submission fails a check."""
    for each in all_checks(folder, None, False, jobs):
        if not each.ok:
            print(f"not submitted, its check fails: {each.name}: {each.told}", file=sys.stderr)
            print(f"Mend it, then: colift check {folder}", file=sys.stderr)
            raise typer.Exit(1)


def _evaluated(board: Board, submission: Submission, jobs: int) -> Entry:
    """Return the submission's new entry, or leave with the reason why there is none."""
    total = work(board, board.season)
    try:
        with local_pool(jobs) as pool, stage_bar(submission.manifest.name, total) as (stage, done):
            watch = Watch(stage=stage, progress=done)
            return enter(board, submission, executor=pool, watch=watch)
    except EvaluatorFault as fault:
        print(f"evaluator fault, not the policy's: {fault}", file=sys.stderr)
        print("Nothing was recorded; submit again.", file=sys.stderr)
    except KeyboardInterrupt:
        print("interrupted: nothing was recorded; submit again.", file=sys.stderr)
    raise typer.Exit(1)
