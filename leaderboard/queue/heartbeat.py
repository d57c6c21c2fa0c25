"""Heartbeat of a worker: a thread that reports a job's progress to the queue."""

import threading
from types import TracebackType
from typing import Final, Self

import sqlalchemy as sa
from colift.leaderboard.evaluation.progress import HIDDEN, Callbacks, Stage
from colift.leaderboard.queue import LostError, WorkerQueue
from colift.leaderboard.records.job import Job

PERIOD_S: Final = 1.0
"""Longest time between two heartbeats [s]; at most a fifth of the lease."""


class Heartbeat:
    """Context manager that reports a job's progress to the queue.

    Episodes may take longer than a lease, so the heartbeat does not wait for them.

    Parameters
    ----------
    work, job
        The queue and the job.
    watch
        Further progress callbacks.
    """

    def __init__(self, work: WorkerQueue, job: Job, watch: Callbacks | None = None) -> None:
        self.stage: Stage | None = None
        self._work, self._job, self._total = work, job, job.total
        self._also = watch or Callbacks()
        self._done, self._lost = 0, False
        self._period = min(PERIOD_S, work.lease.total_seconds() / 5)
        self._news, self._end = threading.Event(), threading.Event()
        self._thread = threading.Thread(target=self._beat, daemon=True)

    def __enter__(self) -> Self:
        """Begin."""
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """End the heartbeats."""
        self._end.set()
        self._news.set()
        self._thread.join()

    def watch(self) -> Callbacks:
        """Return the callbacks of an evaluation; they raise LostError if the job was lost."""
        return Callbacks(
            stage=self._on_stage,
            progress=self._on_progress,
            total=self._on_total,
            output=self._also.output,
        )

    def _on_stage(self, stage: Stage) -> None:
        self.stage = stage
        self._news.set()
        self._also.stage(stage)
        self._check()

    def _on_progress(self, episodes: int) -> None:
        if self.stage != HIDDEN:  # It would reveal the time a policy takes for each hidden lift.
            self._done += episodes
        self._also.progress(episodes)
        self._check()

    def _on_total(self, episodes: int) -> None:
        self._total = episodes
        self._also.total(episodes)

    def _check(self) -> None:
        if self._lost:
            raise LostError(f"job {self._job.id} was given to another worker")

    def _beat(self) -> None:
        while not self._end.is_set():
            try:
                self._work.report(self._job, self.stage, self._done, self._total)
            except LostError:
                self._lost = True
                return
            except sa.exc.DBAPIError:
                pass  # The database is away or busy: the lease limits for how long.
            self._news.wait(self._period)
            self._news.clear()
