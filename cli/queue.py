"""``colift queue``: what waits at a board, what came of it and why, another try, or none."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Final

import typer

from ..agents.errors import InputError
from ..leaderboard.board.board import LOCAL, Board
from ..leaderboard.practice.shipped import open_stocked, open_to_read
from ..leaderboard.queue import Queue
from ..leaderboard.records.job import STATES, Job
from .printing import left, show, table

app = typer.Typer(
    help="See what waits at a board and what came of it, try again, or cancel.",
    no_args_is_help=True,
)

BoardOption = Annotated[
    Path, typer.Option("--board", metavar="PATH", help="The board's folder; made if there is none.")
]
WhyOption = Annotated[str, typer.Option(help="Why, for everybody to read.")]
JobArgument = Annotated[
    str, typer.Argument(metavar="JOB", help="Its number in 'colift queue list', or the beginning.")
]

SHORT: Final = 8
"""Digits of a job's number that a list shows."""

MOST: Final = 1000
"""Jobs among which one is looked for by the beginning of its number."""


@app.command("list")
def list_jobs(
    board: BoardOption = Path("board"),
    state: Annotated[
        str | None, typer.Option(help=f"Only those that are {', '.join(STATES)}.")
    ] = None,
    last: Annotated[int, typer.Option(metavar="N", min=1, help="How many.")] = 20,
) -> None:
    """List the last jobs, the newest first: how far each is, or why it has no row."""
    known = {each: each for each in STATES}
    if state is not None and state not in known:
        raise InputError(f"--state {state!r} is none of {', '.join(STATES)}")
    with _opened(board, open_to_read) as queue:
        jobs = queue.jobs(known[state] if state else None, last)
    if not jobs:
        print("No job." if state is None else f"No job is {state}.")
        return
    rows = (
        (job.id[:SHORT], job.name, job.submitter, f"{job.submitted_at:%Y-%m-%d %H:%M}", _state(job))
        for job in jobs
    )
    titles = ("job", left("policy"), left("by"), "submitted", left("state"))
    show(table("", titles, rows))


@app.command()
def log(job: JobArgument, board: BoardOption = Path("board")) -> None:
    """Print what the workers wrote of a job."""
    with _found(board, job, open_to_read) as (_, found):
        print((found.log or "No worker has begun it.").rstrip())


@app.command()
def retry(job: JobArgument, why: WhyOption, board: BoardOption = Path("board")) -> None:
    """Queue a job again that has ended without an entry, such as by a fault of the machine."""
    with _found(board, job) as (queue, found):
        queue.retry(found.id, LOCAL, why)
    print(f"{found.name} is queued again\nNext: colift worker --board {board} --once")


@app.command("cancel")
def cancel_job(job: JobArgument, why: WhyOption, board: BoardOption = Path("board")) -> None:
    """Take a job out of the queue, also one that is worked on; 'retry' puts it back."""
    with _found(board, job) as (queue, found):
        queue.cancel(found.id, LOCAL, why)
    print(f"{found.name} is cancelled")


@contextmanager
def _opened(folder: Path, opening: Callable[[Path], Board] = open_stocked) -> Iterator[Queue]:
    place = opening(folder)
    try:
        yield Queue(place)
    finally:
        place.close()


@contextmanager
def _found(
    folder: Path, beginning: str, opening: Callable[[Path], Board] = open_stocked
) -> Iterator[tuple[Queue, Job]]:
    """Open the queue of a board, and find a job by its number or the beginning of that."""
    with _opened(folder, opening) as queue:
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
