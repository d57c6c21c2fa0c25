"""Submissions to a board in a folder: evaluated by this process, unless a worker has it."""

import time
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from ..agents.submissions.submission import Submission
from ..benchmark.execution.pool import local_pool
from ..leaderboard.board.board import Board
from ..leaderboard.evaluation.progress import Callbacks
from ..leaderboard.practice.shipped import open_stocked
from ..leaderboard.queue import NO_QUOTA, Queue, WorkerQueue
from ..leaderboard.queue.worker import Worker
from ..leaderboard.records.job import Job
from .progress import job_bar
from .tables.row import Outcome

LOOK_S = 0.5
"""How often another worker's job is looked at [s]."""


@dataclass(frozen=True)
class Here:
    """A board in a folder."""

    board: Board

    @classmethod
    def open(cls, folder: Path, suite: str | None) -> Self:
        """Return the board in a folder; see :func:`.open_stocked`."""
        return cls(open_stocked(folder, suite))

    def close(self) -> None:
        """Close it."""
        self.board.close()

    def known(self, submission: Submission) -> bool:
        """Return whether the board has said in this season what comes of a submission."""
        return self.board.entry(self.board.season.name, submission.contents.digest) is not None

    def submitted(self, submission: Submission, jobs: int) -> Outcome:
        """Return what comes of a submission; it is evaluated if that was not done before."""
        queue = Queue(self.board, quota=NO_QUOTA)
        job = queue.enqueue(self.board.keep(submission.folder))
        if not job.ended:
            try:
                job = _evaluated(queue, job, jobs)
            except KeyboardInterrupt:
                return Outcome(reason=f"interrupted: nothing was recorded; {self._goes_on}")
        return self._outcome(job)

    def _outcome(self, job: Job) -> Outcome:
        if job.state == "evaluator fault":
            told = f"evaluator fault, not the policy's: {job.reason}\nNothing was recorded; "
            return Outcome(reason=told + self._goes_on)
        entry = self.board.entry(job.season, job.submission)
        place = self.board.bundle(job.season, job.submission)
        if entry is None or entry.row is None:
            told = f"refused, so there is no row: {job.reason}"
            if place is not None:
                told += f"\nIts public run: {place}"
            return Outcome(reason=told, mend=True)
        standings = self.board.standings(job.season)
        mine = next(each for each in standings if each.row.submission == job.submission)
        return Outcome(
            row=mine.row,
            section=mine.section,
            ranking=tuple(
                (each.group, each.row) for each in standings if each.section == mine.section
            ),
            next=f"Bundle of the public run: {place}\nNext: colift verify {place}",
        )

    @property
    def _goes_on(self) -> str:
        return f"submit again, or: colift worker --board {self.board.folder} --once"


def _evaluated(queue: Queue, job: Job, jobs: int) -> Job:
    """Return a job that has ended, or failed by this machine's fault."""
    worker, now = None, job
    with local_pool(jobs) as pool, job_bar(job.name, job.total) as bar:
        watch = Callbacks(stage=bar.stage, progress=bar.advance, total=bar.total)
        worker = Worker(WorkerQueue(queue.board), pool)
        while True:
            mine = worker.once(job.id, watch)
            now = mine or queue.job(job.id) or now
            if now.ended or (mine is not None and now.state == "evaluator fault"):
                return now
            bar.at(now.stage or now.state, now.done, now.total)
            time.sleep(LOOK_S)
