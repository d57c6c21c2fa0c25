"""``colift worker``: evaluation of the submissions in a board's queue."""

import sys
from typing import Annotated

import typer
from colift.agents.spec import AUTO
from colift.cli.board_options import (
    BOARD,
    BoardFolder,
    BoardIsolation,
    open_patiently,
    opened_board,
    report_isolation,
)
from colift.cli.options import Dask, Jobs, executor
from colift.cli.signals import until_signalled
from colift.leaderboard.logs import write_log
from colift.leaderboard.practice.season_import import open_with_practice
from colift.leaderboard.queue import WorkerQueue
from colift.leaderboard.queue.worker import Worker
from colift.leaderboard.records.job import Job


def worker(
    board: BoardFolder = BOARD,
    jobs: Jobs = None,
    dask: Dask = None,
    isolation: BoardIsolation = AUTO,
    once: Annotated[
        bool, typer.Option("--once", help="End when the queue is empty, instead of waiting.")
    ] = False,
    verbose: Annotated[
        bool,
        typer.Option(
            "--verbose", "-v", help="Print the system's own words if a sandbox does not work."
        ),
    ] = False,
) -> None:
    """Evaluate the submissions in a board's queue, one after the other.

    Any number of workers may share a board. If one is killed, another takes over its job. A worker
    waits for a database server that is away.

    Example: colift worker --board board --jobs 4
    """
    with until_signalled("ended; an unfinished evaluation is back in the queue"):
        if verbose:
            write_log("colift.sandbox")
        report_isolation(isolation)
        opening = open_with_practice if once else open_patiently
        with opened_board(board, opening, new=True) as place, executor(jobs, dask) as workers:
            here = Worker(WorkerQueue(place), workers, isolation=isolation)
            if once:
                with here.attending():
                    while (job := here.once()) is not None:
                        _report(job)
            else:
                print(f"working for {place.folder}; Ctrl-C ends it", file=sys.stderr, flush=True)
                here.run(ended=_report)


def _report(job: Job) -> None:
    reason = "" if job.reason is None else f": {job.reason.splitlines()[0]}"
    print(f"{job.name} ({job.submission[:16]}) {job.state}{reason}", flush=True)
