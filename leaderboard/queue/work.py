"""The worker's side of the queue: claims, progress reports and ends of jobs.

A worker has a job as long as its heartbeats arrive. Every change is one transaction that first
checks whether the job is still its worker's, so a worker that lost a job cannot change it. All
times are those of the database's clock, so the clocks of the workers do not matter.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any, Final

import sqlalchemy as sa
from colift.leaderboard.core.board import Board
from colift.leaderboard.database.queries import record_entry
from colift.leaderboard.database.schema import jobs
from colift.leaderboard.evaluation.progress import Stage
from colift.leaderboard.queue.attendance import LEASE, is_held, sign_in, sign_out
from colift.leaderboard.queue.jobs import job_outcome, read_job, storable_reason
from colift.leaderboard.queue.quota import in_turn, last_served
from colift.leaderboard.records.job import HELD, Job, State
from colift.leaderboard.records.season import BoardEntry

FAULTS: Final = 3
"""Maximum number of retries after faults of this machine."""

LOST: Final = 50
"""Maximum number of times that a job is taken from a dead worker; stops jobs that crash every
worker."""

PAUSE: Final = timedelta(seconds=10)
"""Wait before the first retry after a fault; it doubles each time."""

POSTPONED: Final = timedelta(minutes=1)
"""Wait before the next attempt at a job that this machine cannot run at all."""

LONGEST: Final = max(PAUSE * 2**FAULTS, POSTPONED) + timedelta(seconds=30)
"""Longest wait of a job for its next attempt; a longer one comes from a clock that was wrong."""

VERIFYING: Final[Stage] = "verification"
"""The stage that has its own state."""


class LostError(Exception):
    """The job is no longer this worker's: its lease has ended, and another worker took it."""


@dataclass(frozen=True)
class WorkerQueue:
    """The jobs of a board, for its workers."""

    board: Board
    lease: timedelta = LEASE

    def claim(self, worker: str, job: str | None = None) -> Job | None:
        """Assign the next job to a worker and return it, or None if none waits.

        Submitters take turns, see :func:`.in_turn`. A job waits again if its worker sent no
        heartbeat for a lease, or was a process of this machine that has ended. A time too far ahead
        comes from a wrong clock and counts as passed.

        Parameters
        ----------
        worker
            Name of the worker.
        job
            Id of the wanted job; None is any.
        """
        waits = jobs.c.state.in_(("queued", "evaluator fault")) & jobs.c.ended_at.is_(None)
        with self._now() as (connection, now):
            if job is None:
                sign_in(connection, worker, now)
            passed = (jobs.c.ready_at <= now) | (jobs.c.ready_at > now + LONGEST)
            query = sa.select(jobs).where((waits & passed) | jobs.c.state.in_(HELD))
            found = [dict(each) for each in connection.execute(query).mappings()]
            held = [each for each in found if is_held(each, now, self.lease)]
            waiting = [each for each in found if each not in held and job in (None, each["id"])]
            submitters = [each["submitter"] for each in held]
            for each in in_turn(waiting, submitters, last_served(connection)):
                this, lost = jobs.c.id == each["id"], each["lost"] + (each["state"] in HELD)
                if lost > LOST:
                    reason = f"{lost} workers that had it sent no more heartbeats"
                    ended = {"state": "evaluator fault", "reason": reason, "ended_at": now}
                    connection.execute(sa.update(jobs).where(this).values(**ended))
                    continue
                taken = {
                    "state": "running",
                    "stage": None,
                    "done": 0,
                    "started_at": each["started_at"] or now,
                    "heartbeat_at": now,
                    "worker": worker,
                    "attempt": each["attempt"] + 1,
                    "lost": lost,
                }
                connection.execute(sa.update(jobs).where(this).values(**taken))
                return read_job({**each, **taken}, self.board.store)
        return None

    def report(
        self, job: Job, stage: Stage | None = None, done: int = 0, total: int | None = None
    ) -> None:
        """Send a heartbeat and report progress.

        Parameters
        ----------
        job
            What :meth:`claim` has returned.
        stage
            The current stage.
        done, total
            Finished episodes and their total; a total of None leaves it unchanged.

        Raises
        ------
        LostError
            If the job is no longer this worker's.
        """
        state: State = "verifying" if stage == VERIFYING else "running"
        content: dict[str, Any] = {"state": state, "stage": stage, "done": done}
        with self._now() as (connection, now):
            content |= {"heartbeat_at": now} | ({} if total is None else {"total": total})
            self._change(connection, job, content)

    def finish(
        self,
        job: Job,
        entry: BoardEntry,
        hidden_rmse_mm: Sequence[float] = (),
        bundle: Path | None = None,
    ) -> None:
        """Publish the result of a job in one transaction.

        The bundle is moved into its place before the transaction ends. A worker killed in between
        leaves a bundle without an entry, which the next attempt replaces.

        Parameters
        ----------
        job
            What :meth:`claim` has returned.
        entry
            The row, or the refusal: then the job has failed. Its time becomes the database's.
        hidden_rmse_mm
            RMSE of each hidden episode [mm], if there is a row.
        bundle
            Folder of the public run; it is moved.

        Raises
        ------
        LostError
            If the job is no longer this worker's.
        """
        with self._now() as (connection, now):
            entry = replace(entry, at=now)
            ended = job_outcome(entry, now)
            if entry.row is not None:
                ended["done"] = jobs.c.total
            self._change(connection, job, ended)
            if bundle is not None:
                self.board.store.place_bundle(job.season, job.submission, bundle)
            record_entry(connection, entry, hidden_rmse_mm)

    def fail(self, job: Job, reason: str, log: str = "") -> None:
        """End a job that failed by the submission's fault; :class:`LostError` as :meth:`report`."""
        ended = {"state": "failed", "reason": storable_reason(reason)}
        with self._now() as (connection, now):
            self._change(connection, job, {**ended, "ended_at": now})
        if log:
            self.board.store.add_to_log(job.id, log)

    def fault(self, job: Job, reason: str) -> None:
        """Queue a job again after a fault of this machine, or end it after :data:`FAULTS` times.

        It does not count towards the submitter's quota. :class:`LostError` as :meth:`report`.
        """
        with self._now() as (connection, now):
            faults: int = connection.execute(
                sa.select(jobs.c.faults).where(jobs.c.id == job.id)
            ).scalar_one()
            content = {
                "state": "evaluator fault",
                "reason": storable_reason(reason),
                "faults": faults + 1,
                "ready_at": now + PAUSE * 2**faults,
                "ended_at": now if faults >= FAULTS else None,
            }
            self._change(connection, job, content)

    def postpone(self, job: Job, reason: str) -> None:
        """Postpone a job that no worker can run here for now, without a limit; as :meth:`fault`."""
        content = {
            "state": "evaluator fault",
            "reason": storable_reason(reason),
            "stage": None,
            "done": 0,
        }
        with self._now() as (connection, now):
            self._change(connection, job, {**content, "ready_at": now + POSTPONED})

    def release(self, job: Job) -> None:
        """Return an interrupted job to the queue; :class:`LostError` as :meth:`report`."""
        content = {"state": "queued", "stage": None, "done": 0}
        with self._now() as (connection, now):
            self._change(connection, job, {**content, "ready_at": now})

    def leave(self, worker: str) -> None:
        """Record that a worker ends: it takes no more jobs."""
        with self.board.database.writing() as connection:
            sign_out(connection, worker)

    @contextmanager
    def _now(self) -> Iterator[tuple[sa.Connection, datetime]]:
        """Yield a connection that writes, and the time of the database."""
        with self.board.database.writing() as connection:
            yield connection, self.board.database.now(connection)

    def _change(self, connection: sa.Connection, job: Job, content: dict[str, Any]) -> None:
        """Change a job if it is still its worker's."""
        own = (
            (jobs.c.id == job.id)
            & (jobs.c.worker == job.worker)
            & (jobs.c.attempt == job.attempt)
            & jobs.c.state.in_(HELD)
        )
        if not connection.execute(sa.update(jobs).where(own).values(**content)).rowcount:
            raise LostError(f"job {job.id} is no longer that of {job.worker}")
