"""``colift submit``: a submission to a board in a folder or on the web, and its row."""

import sys
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Any, Final, NoReturn

import typer
from colift.agents.submissions.manifest import MANIFEST
from colift.agents.submissions.new import check_author
from colift.agents.submissions.submission import Submission, open_submission
from colift.base.errors import InputError
from colift.benchmark.execution.pool import checked_jobs, local_pool
from colift.benchmark.execution.progress import job_bar
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tables.printing import show
from colift.benchmark.verification.checking import SUITE, checked_with
from colift.cli.board_options import opened_board, web_address
from colift.cli.check import submission_checks
from colift.cli.completion import suites
from colift.cli.options import Jobs
from colift.cli.remedies import argument
from colift.cli.tables.row import SectionRow, row_table, row_text
from colift.leaderboard.client import RemoteBoard
from colift.leaderboard.core.board import SUITE as NEW
from colift.leaderboard.core.board import Board
from colift.leaderboard.evaluation.progress import Callbacks
from colift.leaderboard.practice.season_import import open_with_practice
from colift.leaderboard.queue import NO_QUOTA, Queue, WorkerQueue
from colift.leaderboard.queue.worker import Worker
from colift.leaderboard.records.job import Job
from colift.leaderboard.records.row import BoardRow
from colift.leaderboard.records.season import check_season_suite

POLL_S: Final = 0.5
"""Time between two queries of a job that another process evaluates [s]."""

RANK_POLL_S: Final = 2.0
"""Time between two queries of a table that has no rank of a new row yet [s]."""

RANKED_S: Final = 600.0
"""Longest wait for the rank [s]; ranks of thousands of rows take seconds."""


def submit_policy(
    context: typer.Context,
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="The submission's folder.")],
    board: Annotated[
        str,
        typer.Option(
            metavar="PATH|URL",
            help="The board's folder, created if missing; or its address, https://...",
        ),
    ],
    suite: Annotated[
        str | None,
        typer.Option(
            metavar="NAME",
            help=f"Suite that the board must have; default of a new board: {NEW}.",
            autocompletion=suites,
        ),
    ] = None,
    jobs: Jobs = None,
    token: Annotated[
        str,
        typer.Option(
            metavar="TOKEN",
            envvar="COLIFT_TOKEN",
            help="Your token for a board on the web, from its maintainer.",
        ),
    ] = "",
) -> None:
    """Submit a policy to a board: check, public and hidden lifts, audit, verification, row.

    For a board in a folder, this command evaluates it; a board on the web has its own workers, and
    this command says so if none is there.

    Example: colift submit mine --board board
    """
    count = checked_jobs(jobs)
    submission = open_submission(folder)
    check_author(submission.manifest, f"{folder}/{MANIFEST}")
    if board.startswith(("http://", "https://")):
        _submit_to_web(submission, folder, board, suite, token, count)
    else:
        # A token in the environment is for other boards; one on the command line is for this one.
        source = context.get_parameter_source("token")
        _check_folder(board, source is not None and source.name == "COMMANDLINE")
        with opened_board(
            Path(board), lambda path: open_with_practice(path, suite), new=True
        ) as place:
            _submit_to_folder(submission, folder, place, count)


def _check_folder(board: str, with_token: bool) -> None:
    """Refuse an address without ``http://``, and a token, which a folder does not need."""
    address = web_address(board)
    if address is not None:
        raise InputError(f"--board {board} is no folder: did you mean {address}?")
    if with_token:
        raise InputError(
            f"--board {board} is a folder, which takes no --token: give the address of a board on "
            "the web, https://..., or leave the token out"
        )


def _submit_to_folder(submission: Submission, folder: Path, board: Board, jobs: int) -> None:
    """Evaluate a submission unless its board has an entry of it, and print its row."""
    if board.entry(board.season.name, submission.contents.digest) is None:
        _check(submission, folder, board.season.suite.name, jobs)
    else:
        print(f"This content (digest {submission.digest}) is on the board already.")
    queue = Queue(board, quota=NO_QUOTA)
    job = queue.enqueue(board.keep(submission.folder))
    again = f"submit again, or: colift worker --board {board.folder} --once"
    try:
        job = job if job.ended else _evaluated(queue, job, jobs)
    except KeyboardInterrupt:
        _refuse(f"interrupted: nothing was recorded; {again}")
    if job.state == "evaluator fault":
        _refuse(f"evaluator fault, not the policy's: {job.reason}\nNothing was recorded; {again}")
    entry = board.entry(job.season, job.submission)
    bundle = board.bundle(job.season, job.submission)
    if entry is None or entry.row is None:
        public = "" if bundle is None else f"\nIts public run: {bundle}"
        _refuse(f"refused, so there is no row: {job.reason}{public}", fix=folder)
    rows = ((each.section, each.rank, each.row) for each in board.standings(job.season))
    _show_row(job.submission, rows)
    print(f"Bundle of the public run: {bundle}\nNext: colift verify {bundle}")


def _evaluated(queue: Queue, job: Job, jobs: int) -> Job:
    """Return the job when it has ended, or after a fault of this machine.

    This process evaluates it, unless a worker already does.
    """
    with local_pool(jobs) as pool, job_bar(job.name, job.total, words=True) as bar:
        watch = Callbacks(stage=bar.stage, progress=bar.advance, total=bar.total)
        worker = Worker(WorkerQueue(queue.board), pool)
        while True:
            mine = worker.once(job.id, watch)
            job = mine or queue.job(job.id) or job
            if job.ended or (mine is not None and job.state == "evaluator fault"):
                return job
            bar.at(job.stage or job.state, job.done, job.total)
            time.sleep(POLL_S)


def _submit_to_web(
    submission: Submission, folder: Path, url: str, suite: str | None, token: str, jobs: int
) -> None:
    """Upload a submission, follow its evaluation, and print its row."""
    if not token:
        raise InputError(
            f"board {url} needs a token: --token or COLIFT_TOKEN; ask the maintainer of the board "
            "for one"
        )
    board = RemoteBoard(url, token)
    board.submitter()  # Refuses an unknown token before any work is done.
    current = board.suite()
    check_season_suite(url, current, suite)
    _check(submission, folder, current, jobs)
    from colift.leaderboard.pages.links import Links  # With all pages, which take long to import.

    job = board.submit(submission.folder)
    links = Links(board.url.rstrip("/"))
    page = links.job(job["id"])
    print(f"submitted; job {page}", flush=True)
    try:
        job = _followed(board, job)
    except KeyboardInterrupt:
        _refuse(f"interrupted here; the board continues the evaluation: {page}")
    if job["state"] == "evaluator fault":
        _refuse(f"evaluator fault, not the policy's: {job['reason']}\nSubmit again.")
    if job["state"] == "cancelled":
        _refuse(f"cancelled by {job['reason']}; to have it evaluated, ask the board's maintainer")
    if job["state"] == "failed":
        _refuse(f"refused, so there is no row: {job['reason']}\nIts log: {page}", fix=folder)
    season, digest = job["season"], job["submission"]
    _show_row(
        digest,
        (
            (each["section"], each["rank"], BoardRow.read(each["row"]))
            for each in _ranked(board, season, digest)
        ),
    )
    print(f"Bundle of the public run: {links.bundle(season, digest)}")
    print(f"Its page: {links.policy(season, digest)}")


def _ranked(board: RemoteBoard, season: str, digest: str) -> list[dict[str, Any]]:
    """Return a season's table when it has the rank of a submission, or after a while without."""
    end = time.monotonic() + RANKED_S
    while True:
        table = board.standings(season)
        pending = any(each["row"]["submission"] == digest and each.get("pending") for each in table)
        if not pending or time.monotonic() > end:
            return table
        time.sleep(RANK_POLL_S)


def _followed(board: RemoteBoard, job: dict[str, Any]) -> dict[str, Any]:
    """Return a job when it has ended; show its progress until then."""
    told = None
    with job_bar(job["name"], job["total"], words=True) as bar:
        while job["ended_at"] is None:
            missed = job.get("unattended")  # A board of an earlier colift does not say it.
            if missed is not None and missed != told:
                note = f"{missed}. The submission is kept, and waits; Ctrl-C ends only this command"
                bar.note(note)
            told = missed
            bar.at(job["stage"] or job["state"], job["done"], job["total"])
            time.sleep(POLL_S)
            job = board.job(job["id"])
    return job


def _check(submission: Submission, folder: Path, suite: str, jobs: int) -> None:
    """End with the reason if the submission fails a check with the task of the board's suite."""
    played = checked_with(make_suite(suite))
    option = "" if played.name == SUITE else f" --suite {suite}"
    for each in submission_checks(submission, None, False, jobs, played):
        if not each.ok:
            reason = f"not submitted, its check fails: {each.name}: {each.message}"
            _refuse(reason, fix=folder, option=option)
        if each.name == "manifest" and each.warning:  # It is published as it is.
            print(f"warning: {each.message}", file=sys.stderr, flush=True)


def _refuse(reason: str, fix: Path | None = None, option: str = "") -> NoReturn:
    """End with the reason why there is no row, and the folder to fix, if any."""
    print(reason, file=sys.stderr)
    if fix is not None:
        print(f"Fix the submission, then: colift check {argument(fix)}{option}", file=sys.stderr)
    raise typer.Exit(1)


def _show_row(digest: str, rows: Iterable[SectionRow]) -> None:
    """Print the row of a submission and its rank among the rows of its season."""
    known = list(rows)
    section, _, row = next(each for each in known if each[2].submission == digest)
    ranking = [(group, other) for place, group, other in known if place == section]
    show(row_table(row), row_text(row, ranking, section))
