"""``colift queue``: what waits at a board, what came of it and why, and another try."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Final

import typer
from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..agents.errors import InputError
from ..leaderboard.board import LOCAL, Board
from ..leaderboard.job import STATES, Job
from ..leaderboard.opening import open_stocked
from ..leaderboard.queue import Queue

app = typer.Typer(
    help="See what waits at a board and what came of it, and try again.", no_args_is_help=True
)

BoardOption = Annotated[
    Path, typer.Option("--board", metavar="PATH", help="The board's folder; made if there is none.")
]
JobArgument = Annotated[
    str, typer.Argument(metavar="JOB", help="Its number in 'colift queue list', or the beginning.")
]

SHORT: Final = 8
"""Digits of a job's number that a list shows."""

MOST: Final = 1000
"""Jobs among which one is looked for by the beginning of its number."""


@app.command("list")
def list_all(
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
    with _opened(board) as queue:
        jobs = queue.jobs(known[state] if state else None, last)
    if not jobs:
        print("No job." if state is None else f"No job is {state}.")
        return
    table = Table("job", "policy", "by", box=box.SIMPLE_HEAD)
    table.add_column("submitted", no_wrap=True)
    table.add_column("state", overflow="fold")
    for job in jobs:
        told = (job.id[:SHORT], job.name, job.submitter, f"{job.submitted_at:%Y-%m-%d %H:%M}")
        table.add_row(*map(Text, (*told, _state(job))))
    Console().print(table)


@app.command()
def log(job: JobArgument, board: BoardOption = Path("board")) -> None:
    """Print what the workers wrote of a job."""
    with _opened(board) as queue:
        print((_the(queue, job).log or "No worker has begun it.").rstrip())


@app.command()
def retry(
    job: JobArgument,
    why: Annotated[str, typer.Option(help="Why, for everybody to read.")],
    board: BoardOption = Path("board"),
) -> None:
    """Queue a job again that has ended without an entry, such as by a fault of the machine."""
    with _opened(board) as queue:
        found = _the(queue, job)
        queue.retry(found.id, LOCAL, why)
    print(f"{found.name} is queued again\nNext: colift worker --board {board} --once")


@contextmanager
def _opened(folder: Path) -> Iterator[Queue]:
    place: Board = open_stocked(folder)
    try:
        yield Queue(place)
    finally:
        place.close()


def _the(queue: Queue, beginning: str) -> Job:
    whole = queue.job(beginning)
    found = [whole] if whole else _beginning(queue, beginning)
    if len(found) != 1:
        many = f"{len(found)} jobs begin" if found else "no job begins"
        raise InputError(f"{many} with {beginning!r}; see: colift queue list")
    return found[0]


def _beginning(queue: Queue, digits: str) -> list[Job]:
    return [job for job in queue.jobs(limit=MOST) if job.id.startswith(digits)]


def _state(job: Job) -> str:
    if job.reason is not None:
        return f"{job.state}: {job.reason}"
    if job.ended or job.stage is None:
        return job.state
    return f"{job.state}: {job.stage}, {job.done} of {job.total}"
