"""``colift worker``: evaluate what is submitted to a board."""

import signal
import sys
from pathlib import Path
from types import FrameType
from typing import Annotated

import sqlalchemy as sa
import typer

from ..agents.errors import EvaluatorFault
from ..leaderboard.evaluation.entrant import AUTO
from ..leaderboard.practice.shipped import open_stocked
from ..leaderboard.queue import WorkerQueue
from ..leaderboard.queue.worker import Worker
from ..leaderboard.records.job import Job
from .board_isolation import Isolation, tell_isolation
from .options import Jobs, executor

ENDING = (signal.SIGINT, signal.SIGTERM)
"""Signals that end a worker."""


def worker(
    board: Annotated[
        Path, typer.Option(metavar="PATH", help="The board's folder; made if there is none.")
    ] = Path("board"),
    jobs: Jobs = None,
    dask: Annotated[
        str | None,
        typer.Option(metavar="URL", help="Use the Dask cluster of this scheduler: tcp://host:8786"),
    ] = None,
    isolation: Isolation = AUTO,
    once: Annotated[
        bool, typer.Option("--once", help="End when nothing waits, instead of waiting for more.")
    ] = False,
) -> None:
    """Take submissions out of a board's queue and evaluate them, one after the other.

    Any number of workers may share a board. One that is killed loses nothing: another begins anew.
    """
    for number in ENDING:
        signal.signal(number, _stop)
    tell_isolation(isolation)
    place = open_stocked(board)
    try:
        with executor(jobs, dask) as workers:
            here = Worker(WorkerQueue(place), workers, isolation=isolation)
            if once:
                while (job := here.once()) is not None:
                    _tell(job)
            else:
                print(f"working for {place.folder}; Ctrl-C ends it", file=sys.stderr, flush=True)
                here.run(ended=_tell)
    except KeyboardInterrupt:
        print("ended; an unfinished evaluation is in the queue again", file=sys.stderr)
    except sa.exc.OperationalError as error:
        raise EvaluatorFault(f"the board's database does not work: {error.orig}") from error
    finally:
        place.close()


def _tell(job: Job) -> None:
    reason = "" if job.reason is None else f": {job.reason.splitlines()[0]}"
    print(f"{job.name} ({job.submission[:16]}) {job.state}{reason}", flush=True)


def _stop(number: int, frame: FrameType | None) -> None:
    for each in ENDING:
        signal.signal(each, signal.SIG_IGN)  # One is enough; a second one would only interrupt it.
    raise KeyboardInterrupt
