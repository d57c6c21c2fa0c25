"""The page of a job: how far a submission is, or how it ended."""

from dataclasses import dataclass
from typing import Final

from ..board.board import Board
from ..evaluation.progress import Stage
from ..queue import Queue
from ..records.job import Job
from ..records.season import BoardEntry

WAITING: Final = 100
"""Jobs that the queue's list shows at most."""

STAGES: Final[tuple[Stage, ...]] = ("check", "public run", "audit", "verification", "hidden run")
"""The stages that every evaluation goes through, in their order."""


@dataclass(frozen=True, kw_only=True)
class JobView:
    """What the page of a job shows."""

    job: Job
    entry: BoardEntry | None
    """What it has come to."""
    ahead: int
    """Jobs that are taken before it."""

    @property
    def share(self) -> float:
        """How much is done, 0 to 1."""
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
    )


def open_jobs(queue: Queue) -> tuple[Job, ...]:
    """Return what is in the queue now, what was submitted first at the top."""
    jobs = [job for job in queue.jobs(limit=WAITING) if not job.ended]
    return tuple(sorted(jobs, key=lambda job: job.submitted_at))
