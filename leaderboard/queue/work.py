"""A worker's side of the queue: taking a job, reporting its progress, and ending it.

A worker has a job for as long as it gives signs of life. Every change is one transaction that asks
first whether the job is still its worker's; so whoever was given up and comes back changes nothing.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any, Final

import sqlalchemy as sa

from ..board.board import Board
from ..database.queries import record_entry
from ..database.schema import jobs
from ..evaluation.progress import Stage
from ..records.job import HELD, Job, State
from ..records.season import BoardEntry
from .jobs import is_gone, outcome, read_job, storable_reason
from .quota import in_turn, last_served

LEASE: Final = timedelta(seconds=30)
"""So long after its worker's last sign of life a job is another's."""

FAULTS: Final = 3
"""How often a job is tried again after this machine failed it."""

LOST: Final = 50
"""Maximum number of times a job is reclaimed from a dead worker; stops jobs that crash every
worker."""

PAUSE: Final = timedelta(seconds=10)
"""Before the first try after a fault; each further one waits twice as long."""

POSTPONED: Final = timedelta(minutes=1)
"""Before the next try of what this machine cannot do at all, so that another may take it."""

LONGEST: Final = max(PAUSE * 2**FAULTS, POSTPONED) + timedelta(seconds=30)
"""No job waits longer for its next try; clocks may differ by some seconds."""

VERIFYING: Final[Stage] = "verification"
"""The stage that is a state of its own."""


class LostError(Exception):
    """The job is no longer this worker's: it was given up, and another has it or had it."""


@dataclass(frozen=True)
class WorkerQueue:
    """The jobs of a board, for whoever works on them."""

    board: Board
    lease: timedelta = LEASE

    def claim(self, worker: str, job: str | None = None) -> Job | None:
        """Return the job that a worker has now to do, or None if nothing waits.

        Submitters take turns, see :func:`.in_turn`. What has a worker that gave no sign of life for
        a lease, or was a process of this machine that is gone, waits again. A time that lies
        further ahead than any can is of a clock that was wrong: it counts as passed.

        Parameters
        ----------
        worker
            Who takes it.
        job
            Id of the only one that is wanted; None is any.
        """
        now = self.board.clock()
        passed = (jobs.c.ready_at <= now) | (jobs.c.ready_at > now + LONGEST)
        waits = jobs.c.state.in_(("queued", "evaluator fault")) & jobs.c.ended_at.is_(None)
        query = sa.select(jobs).where((waits & passed) | jobs.c.state.in_(HELD))
        with self.board.database.writing() as connection:
            found = [dict(each) for each in connection.execute(query).mappings()]
            held = [each for each in found if self._is_held(each, now)]
            waiting = [each for each in found if each not in held and job in (None, each["id"])]
            submitters = [each["submitter"] for each in held]
            for each in in_turn(waiting, submitters, last_served(connection)):
                this, lost = jobs.c.id == each["id"], each["lost"] + (each["state"] in HELD)
                if lost > LOST:
                    told = f"{lost} workers that had it gave no sign of life any more"
                    ended = {"state": "evaluator fault", "reason": told, "ended_at": now}
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

    def told(
        self, job: Job, stage: Stage | None = None, done: int = 0, total: int | None = None
    ) -> None:
        """Give a sign of life, and say how far the job is.

        Parameters
        ----------
        job
            What :meth:`claim` has returned.
        stage
            What is done now.
        done, total
            Episodes that are finished, of so many; None is as so far.

        Raises
        ------
        LostError
            If the job is no longer this worker's.
        """
        state: State = "verifying" if stage == VERIFYING else "running"
        content = {"state": state, "stage": stage, "done": done, "heartbeat_at": self.board.clock()}
        with self.board.database.writing() as connection:
            self._change(connection, job, content | ({} if total is None else {"total": total}))

    def finish(
        self,
        job: Job,
        entry: BoardEntry,
        hidden_rmse_mm: Sequence[float] = (),
        bundle: Path | None = None,
    ) -> None:
        """Put what has come of a job on the board: all of it or nothing.

        The bundle is moved into its place before the transaction ends. Who is killed in between
        leaves a bundle without an entry, and the next one puts its own there.

        Parameters
        ----------
        job
            What :meth:`claim` has returned.
        entry
            The row, or the refusal: then the job has failed.
        hidden_rmse_mm
            RMSE of each hidden episode [mm], if there is a row.
        bundle
            Folder of the public run; it is moved.

        Raises
        ------
        LostError
            If the job is no longer this worker's.
        """
        with self.board.database.writing() as connection:
            ended = outcome(entry, self.board.clock())
            if entry.row is not None:
                ended["done"] = jobs.c.total
            self._change(connection, job, ended)
            if bundle is not None:
                self.board.store.place_bundle(job.season, job.submission, bundle)
            record_entry(connection, entry, hidden_rmse_mm)

    def fail(self, job: Job, reason: str, log: str = "") -> None:
        """End a job by the submission's own fault; :class:`LostError` as :meth:`told`."""
        ended = {
            "state": "failed",
            "reason": storable_reason(reason),
            "ended_at": self.board.clock(),
        }
        with self.board.database.writing() as connection:
            self._change(connection, job, ended)
        if log:
            self.board.store.add_to_log(job.id, log)

    def fault(self, job: Job, reason: str) -> None:
        """Queue a job again that this machine has failed, or end it after :data:`FAULTS` times.

        It costs the submitter nothing. :class:`LostError` as :meth:`told`.
        """
        now = self.board.clock()
        with self.board.database.writing() as connection:
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
        """Let a job wait that no worker can do here for now, however often; as :meth:`fault`."""
        content = {
            "state": "evaluator fault",
            "reason": storable_reason(reason),
            "stage": None,
            "done": 0,
            "ready_at": self.board.clock() + POSTPONED,
        }
        with self.board.database.writing() as connection:
            self._change(connection, job, content)

    def release(self, job: Job) -> None:
        """Give a job back that was interrupted; :class:`LostError` as :meth:`told`."""
        content = {"state": "queued", "stage": None, "done": 0, "ready_at": self.board.clock()}
        with self.board.database.writing() as connection:
            self._change(connection, job, content)

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

    def _is_held(self, job: Mapping[str, Any], now: datetime) -> bool:
        """Return whether a job has a worker."""
        alive = abs(job["heartbeat_at"] - now) <= self.lease if job["heartbeat_at"] else False
        return job["state"] in HELD and alive and not is_gone(job["worker"])
