"""The queue of a board: what waits, who works on it, and what has come of it.

A worker has a job for as long as it gives signs of life. Every change is one transaction that asks
first whether the job is still its worker's; so whoever was given up and comes back changes nothing.
"""

import uuid
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any, Final

import sqlalchemy as sa

from ..agents.errors import InputError
from ..agents.submissions.submission import Submission
from .board import LOCAL, OWN, Board
from .database.reading import read_entries
from .database.recording import record_entry, record_event
from .database.schema import entries, jobs
from .entry import Entry
from .evaluation import Entrant, Stage, amount
from .event import Event
from .job import HELD, Job, State
from .worker_name import is_gone

LEASE: Final = timedelta(seconds=30)
"""So long after its worker's last sign of life a job is another's."""

FAULTS: Final = 3
"""How often a job is tried again after this machine failed it."""

LOST: Final = 50
"""How often a job is taken from a worker that gave no sign of life: one that takes its workers
with it is not begun for ever."""

PAUSE: Final = timedelta(seconds=10)
"""Before the first try after a fault; each further one waits twice as long."""

REASON: Final = 2000
"""So many characters of a reason are kept."""

VERIFYING: Final[Stage] = "verification"
"""The stage that is a state of its own."""


class QuotaError(InputError):
    """A submitter has too much in the queue, or has failed too often."""


class LostError(Exception):
    """The job is no longer this worker's: it was given up, and another has it or had it."""


@dataclass(frozen=True, kw_only=True)
class Quota:
    """How much a submitter may ask for."""

    open: int = 5
    """Jobs that have not ended."""
    failures: int = 20
    """Jobs that failed within a window; faults of the evaluator are none."""
    window: timedelta = timedelta(days=1)


NO_QUOTA: Final = Quota(open=10**9, failures=10**9)
"""For whoever can write to the board's folder anyway."""


@dataclass(frozen=True)
class Queue:
    """The queue of a board."""

    board: Board
    lease: timedelta = LEASE
    quota: Quota = Quota()

    def enqueue(self, submission: Submission, submitter: str = LOCAL) -> Job:
        """Return the job of a submission in the current season; a new one if there is none.

        The same content has one job a season. If that ended by a fault of the evaluator, it is
        queued again.

        Parameters
        ----------
        submission
            What :meth:`.Board.keep` has returned.
        submitter
            Who submits it.

        Raises
        ------
        QuotaError
            If the submitter has too many open jobs or failures.
        InputError
            If the season cannot be played by this colift.
        """
        return self._enqueue(submission.contents.digest, submission.manifest.name, submitter)

    def enqueue_own(self, entrant: Entrant) -> Job:
        """Return the job of one of the project's own policies, likewise; see :mod:`.own`."""
        return self._enqueue(entrant.digest, entrant.name, OWN)

    def _enqueue(self, digest: str, name: str, submitter: str) -> Job:
        season, now = self.board.season, self.board.clock()
        this = (jobs.c.season == season.name) & (jobs.c.submission == digest)
        fresh = {
            "state": "queued",
            "stage": None,
            "done": 0,
            "ready_at": now,
            "ended_at": None,
            "faults": 0,
            "lost": 0,
            "reason": None,
        }
        with self.board.database.writing() as connection:
            there = connection.execute(sa.select(jobs).where(this)).mappings().first()
            if there is None:
                if submitter != OWN:
                    self._admit(connection, submitter, now)
                known = read_entries(
                    connection, entries.c.season == season.name, entries.c.submission == digest
                )
                fresh |= _outcome(known[0], known[0].at) if known else {}
                connection.execute(
                    sa.insert(jobs).values(
                        id=uuid.uuid4().hex,
                        season=season.name,
                        submission=digest,
                        name=name,
                        submitter=submitter,
                        total=amount(season),
                        submitted_at=now,
                        attempt=0,
                        **fresh,
                    )
                )
            elif there["state"] == "evaluator fault" and there["ended_at"] is not None:
                connection.execute(sa.update(jobs).where(this).values(**fresh))
            found = connection.execute(sa.select(jobs).where(this)).mappings().one()
        return self._job(found)

    def job(self, id: str) -> Job | None:  # noqa: A002
        """Return a job, or None if there is none of that id."""
        with self.board.database.reading() as connection:
            found = connection.execute(sa.select(jobs).where(jobs.c.id == id)).mappings().first()
        return None if found is None else self._job(found)

    def job_of(self, season: str, submission: str) -> Job | None:
        """Return the job of a submission in a season, or None if there is none."""
        this = (jobs.c.season == season) & (jobs.c.submission == submission)
        with self.board.database.reading() as connection:
            found = connection.execute(sa.select(jobs).where(this)).mappings().first()
        return None if found is None else self._job(found)

    def jobs(self, state: State | None = None, limit: int = 100) -> tuple[Job, ...]:
        """Return the last jobs, of one state or of all, the newest first."""
        query = sa.select(jobs).order_by(jobs.c.submitted_at.desc(), jobs.c.id).limit(limit)
        if state is not None:
            query = query.where(jobs.c.state == state)
        with self.board.database.reading() as connection:
            found = connection.execute(query).mappings().all()
        return tuple(map(self._job, found))

    def claim(self, worker: str, job: str | None = None) -> Job | None:
        """Return the job that a worker has now to do, or None if nothing waits.

        The oldest of those that wait, or whose worker gave no sign of life for a lease, or was a
        process of this machine that is gone.

        Parameters
        ----------
        worker
            Who takes it.
        job
            Id of the only one that is wanted; None is any.
        """
        now = self.board.clock()
        waiting = (
            jobs.c.state.in_(("queued", "evaluator fault"))
            & jobs.c.ended_at.is_(None)
            & (jobs.c.ready_at <= now)
        )
        held = jobs.c.state.in_(HELD)
        query = sa.select(jobs).where(waiting | held).order_by(jobs.c.submitted_at, jobs.c.id)
        if job is not None:
            query = query.where(jobs.c.id == job)
        with self.board.database.writing() as connection:
            for found in connection.execute(query).mappings().all():
                if found["state"] in HELD and not self._given_up(found, now):
                    continue
                this, lost = jobs.c.id == found["id"], found["lost"] + (found["state"] in HELD)
                if lost > LOST:
                    told = f"{lost} workers that had it gave no sign of life any more"
                    ended = {"state": "evaluator fault", "reason": told, "ended_at": now}
                    connection.execute(sa.update(jobs).where(this).values(**ended))
                    continue
                taken = {
                    "state": "running",
                    "stage": None,
                    "done": 0,
                    "started_at": found["started_at"] or now,
                    "heartbeat_at": now,
                    "worker": worker,
                    "attempt": found["attempt"] + 1,
                    "lost": lost,
                }
                connection.execute(sa.update(jobs).where(this).values(**taken))
                return self._job({**found, **taken})
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
        entry: Entry,
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
            outcome = _outcome(entry, self.board.clock())
            if entry.row is not None:
                outcome["done"] = jobs.c.total
            self._change(connection, job, outcome)
            if bundle is not None:
                self.board.store.place_bundle(job.season, job.submission, bundle)
            record_entry(connection, entry, hidden_rmse_mm)

    def fail(self, job: Job, reason: str, log: str = "") -> None:
        """End a job by the submission's own fault; :class:`LostError` as :meth:`told`."""
        ended = {"state": "failed", "reason": clean(reason), "ended_at": self.board.clock()}
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
                "reason": clean(reason),
                "faults": faults + 1,
                "ready_at": now + PAUSE * 2**faults,
                "ended_at": now if faults >= FAULTS else None,
            }
            self._change(connection, job, content)

    def release(self, job: Job) -> None:
        """Give a job back that was interrupted; :class:`LostError` as :meth:`told`."""
        content = {"state": "queued", "stage": None, "done": 0, "ready_at": self.board.clock()}
        with self.board.database.writing() as connection:
            self._change(connection, job, content)

    def retry(self, id: str, who: str, why: str) -> None:  # noqa: A002
        """Queue a job again that has ended without an entry, because its keeper wants so.

        Raises
        ------
        InputError
            If there is no such job.
        """
        now = self.board.clock()
        with self.board.database.writing() as connection:
            found = connection.execute(sa.select(jobs).where(jobs.c.id == id)).mappings().first()
            done = found is not None and read_entries(
                connection,
                entries.c.season == found["season"],
                entries.c.submission == found["submission"],
            )
            if found is None or found["ended_at"] is None or done:
                raise InputError(f"no job {id!r} has ended without an entry")
            connection.execute(
                sa.update(jobs)
                .where(jobs.c.id == id)
                .values(
                    state="queued", stage=None, done=0, ready_at=now, ended_at=None,
                    faults=0, lost=0, reason=None,
                )
            )  # fmt: skip
            record_event(
                connection,
                Event(
                    at=now,
                    who=who,
                    kind="retry",
                    why=why,
                    season=found["season"],
                    submission=found["submission"],
                    content=None,
                ),
            )

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

    def _given_up(self, found: Any, now: datetime) -> bool:
        return found["heartbeat_at"] < now - self.lease or is_gone(found["worker"])

    def _admit(self, connection: sa.Connection, submitter: str, now: datetime) -> None:
        """Refuse who asks for too much."""
        count = sa.select(sa.func.count()).select_from(jobs).where(jobs.c.submitter == submitter)
        waiting = connection.scalar(count.where(jobs.c.ended_at.is_(None))) or 0
        if waiting >= self.quota.open:
            raise QuotaError(
                f"{submitter} has {waiting} submissions in the queue, at most {self.quota.open} "
                "may be: wait for one to end"
            )
        recent = (jobs.c.state == "failed") & (jobs.c.ended_at > now - self.quota.window)
        failed = connection.scalar(count.where(recent)) or 0
        if failed >= self.quota.failures:
            hours = self.quota.window / timedelta(hours=1)
            raise QuotaError(
                f"{failed} submissions of {submitter} have failed in the last {hours:g} hours, at "
                f"most {self.quota.failures} may: try 'colift check' first, and come back later"
            )

    def _job(self, found: Any) -> Job:
        own = {name: value for name, value in found.items() if name in Job.__dataclass_fields__}
        return Job(**own, log=self.board.store.log(found["id"]))


def _outcome(entry: Entry, ended_at: datetime) -> dict[str, Any]:
    """Return what a job is after its entry was made."""
    content: dict[str, Any] = {"state": "done", "reason": None, "ended_at": ended_at}
    if entry.row is None:
        content |= {"state": "failed", "reason": clean(entry.refusal or "refused")}
    return content


def clean(reason: str) -> str:
    """Return a reason as any database keeps it: no NUL, no half characters, not too long."""
    text = reason.replace("\0", "").encode(errors="replace").decode()
    return text if len(text) <= REASON else f"{text[: REASON - 3]}..."
