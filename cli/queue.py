"""``colift queue``: the jobs of a board, their logs, retries and cancellations."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Final

import typer
from colift.base.errors import InputError
from colift.benchmark.tables.printing import left, show, table
from colift.cli.board_options import BOARD, ExistingBoard, Why, opened_board
from colift.leaderboard.core.board import LOCAL, Board
from colift.leaderboard.practice.season_import import open_to_read, open_with_practice
from colift.leaderboard.queue import Queue
from colift.leaderboard.records.job import STATES, Job
from colift.leaderboard.records.times import utc_minute

app = typer.Typer(
    help="List, retry and cancel the jobs of a board.",
    no_args_is_help=True,
)

JobNumber = Annotated[
    str,
    typer.Argument(metavar="JOB", help="The job's number in 'colift queue list', or its start."),
]

SHORT: Final = 8
"""Digits of a job's number that the list shows."""

MOST: Final = 1000
"""Number of the latest jobs that are searched by the start of a number."""


@app.command("list")
def list_jobs(
    board: ExistingBoard = BOARD,
    state: Annotated[
        str | None, typer.Option(metavar="STATE", help=f"One of: {', '.join(STATES)}.")
    ] = None,
    last: Annotated[int, typer.Option(metavar="N", min=1, help="Number of jobs.")] = 20,
) -> None:
    """List the latest jobs, newest first, with their progress, or the reason for having no row.

    Example: colift queue list --board board
    """
    known = {each: each for each in STATES}
    if state is not None and state not in known:
        raise InputError(f"--state {state!r} is none of {', '.join(STATES)}")
    with opened_board(board, open_to_read) as place:
        queue = Queue(place)
        jobs = queue.jobs(known[state] if state else None, last)
        waiting = [job for job in jobs if not job.ended]
        missed = queue.unattended(waiting[0]) if waiting else None
    if not jobs:
        print("No job." if state is None else f"No job is {state}.")
        return
    rows = (
        (
            job.id[:SHORT],
            job.name,
            job.submitter,
            utc_minute(job.submitted_at),
            _state(job),
        )
        for job in jobs
    )
    titles = ("job", left("policy"), left("by"), "submitted", left("state"))
    show(table("", titles, rows))
    if missed is not None:
        print(f"{missed}. To start one: colift worker --board {board}")


@app.command()
def log(job: JobNumber, board: ExistingBoard = BOARD) -> None:
    """Print a job's log.

    Example: colift queue log 3f2a --board board
    """
    with _found(board, job, open_to_read) as (_, found):
        print((found.log or "No worker has begun this job.").rstrip())


@app.command()
def retry(job: JobNumber, why: Why, board: ExistingBoard = BOARD) -> None:
    """Queue again a job that ended without an entry, for example after an evaluator fault.

    Example: colift queue retry 3f2a --why 'the disk was full' --board board
    """
    with _found(board, job) as (queue, found):
        queue.retry(found.id, LOCAL, why)
    print(f"{found.name} is queued again\nNext: colift worker --board {board} --once")


@app.command("cancel")
def cancel_job(job: JobNumber, why: Why, board: ExistingBoard = BOARD) -> None:
    """Take a job out of the queue, even while it is evaluated; 'retry' puts it back.

    Example: colift queue cancel 3f2a --why 'sent by mistake' --board board
    """
    with _found(board, job) as (queue, found):
        queue.cancel(found.id, LOCAL, why)
    print(f"{found.name} is cancelled")


@contextmanager
def _found(
    folder: Path, beginning: str, opening: Callable[[Path], Board] = open_with_practice
) -> Iterator[tuple[Queue, Job]]:
    """Open the queue of a board, and find a job by its number or the start of it."""
    with opened_board(folder, opening) as place:
        queue = Queue(place)
        whole = queue.job(beginning)
        jobs = queue.jobs(limit=MOST) if whole is None else (whole,)
        found = [job for job in jobs if job.id.startswith(beginning)]
        if len(found) != 1:
            many = f"{len(found)} jobs begin" if found else "no job begins"
            raise InputError(f"{many} with {beginning!r}; see: colift queue list")
        yield queue, found[0]


def _state(job: Job) -> str:
    if job.reason is not None:
        return f"{job.state}: {job.reason}"
    if job.ended or job.stage is None:
        return job.state
    return f"{job.state}: {job.stage}, {job.done} of {job.total}"
