"""The queue of a board, for submitters and readers."""

import uuid
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from datetime import datetime
from typing import Any

import sqlalchemy as sa
from colift.agents.submissions.submission import Submission
from colift.base.errors import InputError
from colift.leaderboard.core.board import BUILTIN, LOCAL, Board
from colift.leaderboard.database.queries import read_entries, record_event
from colift.leaderboard.database.schema import entries, jobs
from colift.leaderboard.evaluation.entrant import Entrant
from colift.leaderboard.evaluation.evaluate import episode_count
from colift.leaderboard.queue.attendance import Attendance, read_attendance
from colift.leaderboard.queue.jobs import job_outcome, read_job, storable_reason
from colift.leaderboard.queue.quota import Quota, admit, in_turn, last_served
from colift.leaderboard.records.job import HELD, Job, State
from colift.leaderboard.records.season import Event, Kind


@dataclass(frozen=True)
class Queue:
    """The queue of a board, for submitters and readers."""

    board: Board
    quota: Quota = field(default_factory=Quota)

    def enqueue(
        self,
        submission: Submission,
        submitter: str = LOCAL,
        place: Callable[[], object] = lambda: None,
    ) -> Job:
        """Return the job of a submission in the current season; create it if there is none.

        The same content has one job per season. A job that ended with an evaluator fault is queued
        again.

        Parameters
        ----------
        submission
            The submission.
        submitter
            Name of the submitter.
        place
            Called once the submitter may have the job, before workers see it: it puts the files in
            their place, where those of :meth:`.Board.keep` already are.

        Raises
        ------
        QuotaError
            If the submitter has too many open jobs, failures or rows, or too many files are kept.
        InputError
            If the season cannot be played by this colift.
        """
        contents, name = submission.contents, submission.manifest.name
        return self._enqueue(contents.digest, name, submitter, contents.size, place)

    def enqueue_builtin(self, entrant: Entrant) -> Job:
        """Return the job of a built-in policy; as :meth:`enqueue`."""
        return self._enqueue(entrant.digest, entrant.manifest.name, BUILTIN)

    def _enqueue(
        self,
        digest: str,
        name: str,
        submitter: str,
        size: int = 0,
        place: Callable[[], object] = lambda: None,
    ) -> Job:
        season = self.board.season
        this = (jobs.c.season == season.name) & (jobs.c.submission == digest)
        with self.board.database.writing() as connection:
            now = self.board.database.now(connection)
            fresh = _fresh(now)
            there = connection.execute(sa.select(jobs).where(this)).mappings().first()
            if there is None:
                if submitter != BUILTIN:
                    admit(connection, submitter, self.quota, now, size)
                known = read_entries(
                    connection, entries.c.season == season.name, entries.c.submission == digest
                )
                fresh |= job_outcome(known[0], known[0].at) if known else {}
                place()
                connection.execute(
                    sa.insert(jobs).values(
                        id=uuid.uuid4().hex,
                        season=season.name,
                        submission=digest,
                        name=name,
                        submitter=submitter,
                        total=episode_count(season),
                        submitted_at=now,
                        attempt=0,
                        size=size,
                        **fresh,
                    )
                )
            else:
                place()  # The copy there may have been damaged since.
                if there["state"] == "evaluator fault" and there["ended_at"] is not None:
                    connection.execute(sa.update(jobs).where(this).values(**fresh))
            found = connection.execute(sa.select(jobs).where(this)).mappings().one()
        return self._job(found)

    def job(self, id: str) -> Job | None:  # noqa: A002
        """Return the job with that id, or None."""
        with self.board.database.reading() as connection:
            found = connection.execute(sa.select(jobs).where(jobs.c.id == id)).mappings().first()
        return None if found is None else self._job(found)

    def jobs(
        self, state: State | None = None, limit: int = 100, submitter: str | None = None
    ) -> tuple[Job, ...]:
        """Return the last jobs, of one state and submitter or of all, newest first."""
        query = sa.select(jobs).order_by(jobs.c.submitted_at.desc(), jobs.c.id).limit(limit)
        if state is not None:
            query = query.where(jobs.c.state == state)
        if submitter is not None:
            query = query.where(jobs.c.submitter == submitter)
        with self.board.database.reading() as connection:
            found = connection.execute(query).mappings().all()
        return tuple(map(self._job, found))

    def retry(self, id: str, who: str, why: str) -> None:  # noqa: A002
        """Queue again a job that ended without an entry, at the maintainer's request.

        Raises
        ------
        InputError
            If there is no such job.
        """

        def may(connection: sa.Connection, found: sa.RowMapping) -> bool:
            this = (
                entries.c.season == found["season"],
                entries.c.submission == found["submission"],
            )
            return found["ended_at"] is not None and not read_entries(connection, *this)

        refusal = f"no job {id!r} has ended without an entry"
        self._change(id, _fresh, "retry", who, why, may, refusal)

    def cancel(self, id: str, who: str, why: str, submitter: str | None = None) -> Job:  # noqa: A002
        """Take a job that has not ended out of the queue; a worker that has it stops.

        It counts for no quota. The same content is not queued again in this season, except by
        :meth:`retry`.

        Parameters
        ----------
        id
            The job.
        who, why
            The actor and the reason; both are public.
        submitter
            Required submitter of the job; None accepts any.

        Raises
        ------
        InputError
            If there is no such job.
        """

        def may(connection: sa.Connection, found: sa.RowMapping) -> bool:
            return submitter in (None, found["submitter"]) and found["ended_at"] is None

        def ended(now: datetime) -> dict[str, Any]:
            reason = storable_reason(f"{who}: {why}")
            return {"state": "cancelled", "reason": reason, "ended_at": now}

        refusal = f"no job {id!r} is in the queue; see: colift queue list"
        return self._change(id, ended, "cancellation", who, why, may, refusal)

    def _change(
        self,
        id: str,  # noqa: A002
        change: Callable[[datetime], Mapping[str, Any]],
        kind: Kind,
        who: str,
        why: str,
        may: Callable[[sa.Connection, sa.RowMapping], bool],
        refusal: str,
    ) -> Job:
        """Change a job that may be changed, at a time, and record that as an event."""
        this = jobs.c.id == id
        with self.board.database.writing() as connection:
            found = connection.execute(sa.select(jobs).where(this)).mappings().first()
            if found is None or not may(connection, found):
                raise InputError(refusal)
            now = self.board.database.now(connection)
            values = change(now)
            connection.execute(sa.update(jobs).where(this).values(**values))
            record_event(connection, _event(found, now, kind, who, why))
            return self._job({**found, **values})

    def waiting(self) -> tuple[Job, ...]:
        """Return the waiting jobs, in the order in which they are taken if none ends before."""
        query = sa.select(jobs).where(jobs.c.ended_at.is_(None))
        with self.board.database.reading() as connection:
            found = [dict(each) for each in connection.execute(query).mappings()]
            served = last_served(connection)
        held = [each["submitter"] for each in found if each["state"] in HELD]
        waiting = [each for each in found if each["state"] not in HELD]
        return tuple(map(self._job, in_turn(waiting, held, served)))

    def attendance(self) -> Attendance:
        """Return who works for the board now."""
        with self.board.database.reading() as connection:
            return read_attendance(connection, self.board.database.now(connection))

    def unattended(self, job: Job) -> str | None:
        """Return, in words for its submitter, that nobody evaluates a job; None if somebody does.

        It is known at once, not only after the job has waited for long.
        """
        attendance = None if job.ended else self.attendance()
        if attendance is None or attendance.present:
            return None
        return f"Nobody evaluates at present: {attendance}"

    def _job(self, found: Any) -> Job:
        return read_job(found, self.board.store)


def _event(job: Any, at: datetime, kind: Kind, who: str, why: str) -> Event:
    """Return an event of a job's submission."""
    return Event(
        at=at,
        who=who,
        kind=kind,
        why=why,
        season=job["season"],
        submission=job["submission"],
        content=None,
    )


def _fresh(now: datetime) -> dict[str, Any]:
    """Return the state of a job that no worker has begun."""
    return {
        "state": "queued",
        "stage": None,
        "done": 0,
        "ready_at": now,
        "ended_at": None,
        "faults": 0,
        "lost": 0,
        "reason": None,
    }
