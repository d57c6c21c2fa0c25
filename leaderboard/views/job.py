"""The page of a job: the progress of a submission, or its outcome."""

from dataclasses import dataclass
from typing import Final

from ..board.board import Board
from ..evaluation.progress import Stage
from ..queue import Queue
from ..records.job import Job
from ..records.season import BoardEntry

WAITING: Final = 100
"""Maximum number of jobs in the queue's list."""

STAGES: Final[tuple[Stage, ...]] = ("check", "public run", "audit", "verification", "hidden run")
"""The stages that every evaluation goes through, in their order."""


@dataclass(frozen=True, kw_only=True)
class JobView:
    """The content of the page of a job."""

    job: Job
    entry: BoardEntry | None
    """Its outcome."""
    ahead: int
    """Number of jobs that are taken before it."""
    unattended: str | None
    """That nobody evaluates at present; None if somebody does."""

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
    return JobView(
        job=job,
        entry=board.entry(job.season, job.submission) if job.ended else None,
        ahead=waiting.index(job.id) if job.id in waiting else 0,
        unattended=queue.unattended(job),
    )


def open_jobs(queue: Queue) -> tuple[Job, ...]:
    """Return the present queue, oldest submission first."""
    jobs = [job for job in queue.jobs(limit=WAITING) if not job.ended]
    return tuple(sorted(jobs, key=lambda job: job.submitted_at))
