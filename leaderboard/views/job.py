"""The page of a job: the progress of a submission, or its outcome."""

from datetime import timedelta
from typing import Final

from colift.leaderboard.client import API
from colift.leaderboard.core.board import Board
from colift.leaderboard.evaluation.evaluate import stage_episodes
from colift.leaderboard.evaluation.progress import HIDDEN, Stage
from colift.leaderboard.records.job import Job
from colift.leaderboard.views.page import Content, NoPageError, Page, Visit, find_season
from colift.leaderboard.views.suites import season_suite

STAGES: Final[tuple[Stage, ...]] = ("check", "public run", "audit", "verification", "hidden run")
"""The stages that every evaluation goes through, in their order."""


KNOWN: Final = 0.05
"""Share of the lifts from which on the time that is left is estimated."""


def job_page(visit: Visit, job: str) -> Content:
    """Return a job, the time since it was begun, its stages in their order, and its outcome."""
    queue, board = visit.queue, visit.board
    found = None if queue is None else queue.job(job)
    if queue is None or found is None:
        raise NoPageError("There is no such job.")
    waiting = [each.id for each in queue.waiting()] if found.state == "queued" else []
    lifts = _lifts(board, found.season)
    place = STAGES.index(found.stage) if found.stage in STAGES else -1
    elapsed = None if found.started_at is None else board.clock() - found.started_at
    return {
        "season": find_season(board, found.season),
        "job": found,
        "stages": [
            {"name": name, "lifts": lifts.get(name), "over": i < place, "now": i == place}
            for i, name in enumerate(STAGES)
        ],
        "elapsed": elapsed,
        "left": _left(found, elapsed),
        "share": _share(found),
        "entry": board.entry(found.season, found.submission) if found.ended else None,
        "ahead": waiting.index(found.id) if found.id in waiting else 0,
        "unattended": queue.unattended(found),
        "hidden": HIDDEN,
    }


def _left(job: Job, elapsed: timedelta | None) -> timedelta | None:
    """Return the time until a job's end at the speed so far; None without a good estimate.

    In the hidden run no progress is known, and an earlier attempt took time without lifts.
    """
    known = 0 < KNOWN * job.total <= job.done and job.attempt == 1 and job.stage != HIDDEN
    if not known or elapsed is None:
        return None
    return elapsed * ((job.total - job.done) / job.done)


def _share(job: Job) -> float:
    """Return the finished part, 0 to 1."""
    if job.state == "done":
        return 1.0
    return min(job.done / job.total, 1.0) if job.total else 0.0


def _lifts(board: Board, season: str) -> dict[Stage, int]:
    """Return the number of lifts of each stage; nothing if this colift does not play the suite."""
    suite = season_suite(board.season_info(season))
    return {} if suite is None else stage_episodes(suite)


PAGES: Final = (
    Page(
        name="job",
        url="/jobs/{job}",
        view=job_page,
        template="job.html",
        meaning="The progress of a submission; only its submitter knows the address.",
    ),
    Page(name="api_job", url=API + "/jobs/{job}"),
)
