"""Attendance: whether anybody works for a board.

A worker that waits for jobs signs in every few seconds; one that has a job sends its heartbeats.
All times are those of the database's clock.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any, Final

import sqlalchemy as sa
from colift.leaderboard.database.schema import jobs, workers
from colift.leaderboard.queue.jobs import is_gone
from colift.leaderboard.records.job import HELD
from colift.leaderboard.records.times import utc_minute

LEASE: Final = timedelta(seconds=30)
"""Time after the last heartbeat at which another worker may take a job, and after the last
signature at which a worker counts as gone."""

RENEWED: Final = timedelta(seconds=10)
"""Time between two signatures of a waiting worker: each is a write to the disk."""

KEPT: Final = timedelta(days=7)
"""Time for which the signature of a worker is kept."""


@dataclass(frozen=True, kw_only=True)
class Attendance:
    """Who works for a board."""

    present: bool
    """Whether a worker waits for jobs or has one."""
    seen_at: datetime | None
    """Last sign of life of any worker; None if there never was one."""

    def __str__(self) -> str:
        """Return the last sign of life in words."""
        if self.seen_at is None:
            return "no worker of this board has been seen yet"
        return f"no worker of this board has been seen since {utc_minute(self.seen_at)}"


def is_held(job: Mapping[Any, Any], now: datetime, lease: timedelta = LEASE) -> bool:
    """Return whether a job has a worker."""
    alive = job["heartbeat_at"] is not None and abs(job["heartbeat_at"] - now) <= lease
    return job["state"] in HELD and alive and not is_gone(job["worker"])


def sign_in(connection: sa.Connection, worker: str, now: datetime) -> None:
    """Record that a worker waits for jobs, unless it has done so a moment ago."""
    this = workers.c.name == worker
    found = connection.execute(sa.select(workers).where(this)).first()
    if found is None:
        connection.execute(sa.delete(workers).where(workers.c.seen_at < now - KEPT))
        connection.execute(sa.insert(workers).values(name=worker, seen_at=now, ended=False))
    elif found.ended or abs(now - found.seen_at) >= RENEWED:
        connection.execute(sa.update(workers).where(this).values(seen_at=now, ended=False))


def sign_out(connection: sa.Connection, worker: str) -> None:
    """Record that a worker has ended."""
    connection.execute(sa.update(workers).where(workers.c.name == worker).values(ended=True))


def read_attendance(connection: sa.Connection, now: datetime) -> Attendance:
    """Return who works for a board at a time of its database."""
    signed = connection.execute(sa.select(workers)).all()
    held = connection.execute(sa.select(jobs).where(jobs.c.state.in_(HELD))).mappings().all()
    waiting = any(
        not each.ended and abs(now - each.seen_at) <= LEASE and not is_gone(each.name)
        for each in signed
    )
    last = connection.execute(sa.select(sa.func.max(jobs.c.heartbeat_at))).scalar()
    seen = [each.seen_at for each in signed] + ([] if last is None else [last])
    return Attendance(
        present=waiting or any(is_held(each, now) for each in held),
        seen_at=min(max(seen), now) if seen else None,
    )
