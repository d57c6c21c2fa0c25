"""What waits in a board's queue, and what has come of it."""

import uuid
from dataclasses import dataclass, field
from datetime import datetime
from typing import Any

import sqlalchemy as sa

from ...agents.errors import InputError
from ...agents.submissions.submission import Submission
from ..board import LOCAL, OWN, Board
from ..database.reading import read_entries
from ..database.recording import record_event
from ..database.schema import entries, jobs
from ..evaluation import Entrant, amount
from ..event import Event
from ..job import Job, State
from .jobs import outcome, read_job
from .quota import Quota, admit


@dataclass(frozen=True)
class Queue:
    """The queue of a board, for those who submit and those who look."""

    board: Board
    quota: Quota = field(default_factory=Quota)

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
        fresh = _fresh(now)
        with self.board.database.writing() as connection:
            there = connection.execute(sa.select(jobs).where(this)).mappings().first()
            if there is None:
                if submitter != OWN:
                    admit(connection, submitter, self.quota, now)
                known = read_entries(
                    connection, entries.c.season == season.name, entries.c.submission == digest
                )
                fresh |= outcome(known[0], known[0].at) if known else {}
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

    def jobs(self, state: State | None = None, limit: int = 100) -> tuple[Job, ...]:
        """Return the last jobs, of one state or of all, the newest first."""
        query = sa.select(jobs).order_by(jobs.c.submitted_at.desc(), jobs.c.id).limit(limit)
        if state is not None:
            query = query.where(jobs.c.state == state)
        with self.board.database.reading() as connection:
            found = connection.execute(query).mappings().all()
        return tuple(map(self._job, found))

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
            connection.execute(sa.update(jobs).where(jobs.c.id == id).values(**_fresh(now)))
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

    def _job(self, found: Any) -> Job:
        return read_job(found, self.board.store)


def _fresh(now: datetime) -> dict[str, Any]:
    """Return what a job is that nobody has begun."""
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
