"""The page of a job: the progress of a submission, or its outcome."""

from dataclasses import dataclass
from datetime import timedelta
from typing import Final

from colift.leaderboard.board.board import Board
from colift.leaderboard.client import API
from colift.leaderboard.evaluation.evaluation import stage_episodes
from colift.leaderboard.evaluation.progress import HIDDEN, Stage
from colift.leaderboard.queue import Queue
from colift.leaderboard.records.job import Job
from colift.leaderboard.records.season import BoardEntry
from colift.leaderboard.views.page import Content, NoPageError, Page, Visit, find_season
from colift.leaderboard.views.suites import season_suite

STAGES: Final[tuple[Stage, ...]] = ("check", "public run", "audit", "verification", "hidden run")
"""The stages that every evaluation goes through, in their order."""


KNOWN: Final = 0.05
"""Share of the lifts from which on the time that is left is estimated."""


@dataclass(frozen=True, kw_only=True)
class StageView:
    """A stage of an evaluation."""

    name: Stage
    lifts: int | None
    """Number of its lifts; None if this colift does not play the suite."""
    over: bool
    now: bool


@dataclass(frozen=True, kw_only=True)
class JobView:
    """The content of the page of a job."""

    job: Job
    entry: BoardEntry | None
    """Its outcome."""
    ahead: int
    """Number of jobs that are taken before it."""
    stages: tuple[StageView, ...]
    """The stages of its evaluation, in their order."""
    elapsed: timedelta | None
    """Time since it was begun; None if it was not."""
    unattended: str | None
    """That nobody evaluates at present; None if somebody does."""

    @property
    def left(self) -> timedelta | None:
        """Estimate of the time until its end, at the speed so far; None without a good one.

        In the hidden run no progress is known, and an earlier attempt took time without lifts.
        """
        job = self.job
        known = 0 < KNOWN * job.total <= job.done and job.attempt == 1 and job.stage != HIDDEN
        if not known or self.elapsed is None:
            return None
        return self.elapsed * ((job.total - job.done) / job.done)

    @property
    def share(self) -> float:
        """The finished part, 0 to 1."""
        if self.job.state == "done":
            return 1.0
        return min(self.job.done / self.job.total, 1.0) if self.job.total else 0.0


def job_view(board: Board, queue: Queue, job_id: str) -> JobView | None:
    """Return the page of a job; None if there is none of that identifier."""
    job = queue.job(job_id)
    if job is None:
        return None
    waiting = [each.id for each in queue.waiting()] if job.state == "queued" else []
    lifts = _lifts(board, job.season)
    place = STAGES.index(job.stage) if job.stage in STAGES else -1
    return JobView(
        job=job,
        stages=tuple(
            StageView(name=name, lifts=lifts.get(name), over=i < place, now=i == place)
            for i, name in enumerate(STAGES)
        ),
        elapsed=None if job.started_at is None else board.clock() - job.started_at,
        entry=board.entry(job.season, job.submission) if job.ended else None,
        ahead=waiting.index(job.id) if job.id in waiting else 0,
        unattended=queue.unattended(job),
    )


def _lifts(board: Board, season: str) -> dict[Stage, int]:
    """Return the number of lifts of each stage; nothing if this colift does not play the suite."""
    suite = season_suite(board.season_info(season))
    return {} if suite is None else stage_episodes(suite)


def _job(visit: Visit, job: str) -> Content:
    view = None if visit.queue is None else job_view(visit.board, visit.queue, job)
    if view is None:
        raise NoPageError("There is no such job.")
    return {"view": view, "season": find_season(visit.board, view.job.season), "hidden": HIDDEN}


PAGES: Final = (
    Page(
        name="job",
        url="/jobs/{job}",
        view=_job,
        template="job.html",
        meaning="The progress of a submission; only its submitter knows the address.",
    ),
    Page(name="api_job", url=API + "/jobs/{job}"),
)
