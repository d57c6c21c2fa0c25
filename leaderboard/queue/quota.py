"""Quotas of submitters, and the order in which they are served."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from typing import Any, Final

import sqlalchemy as sa

from ...agents.errors import InputError
from ...agents.submissions.folder import MIB
from ..database.schema import jobs


class QuotaError(InputError):
    """A submitter has too much in the queue, on the board or on the disk, or failed too often."""


@dataclass(frozen=True, kw_only=True)
class Quota:
    """How much a submitter may ask for."""

    open: int = 5
    """Jobs that have not ended."""
    failures: int = 20
    """Jobs that failed within a window; faults of the evaluator are none."""
    rows: int = 10
    """Jobs that got a row within a window, those that may still get one included: each row tells a
    little of the hidden lifts."""
    window: timedelta = timedelta(days=1)
    size: int = 2048 * MIB
    """Of all that is kept of a submitter [bytes]."""


NO_QUOTA: Final = Quota(open=10**9, failures=10**9, rows=10**9, size=10**18)
"""For whoever can write to the board's folder anyway."""


def admit(
    connection: sa.Connection, submitter: str, quota: Quota, now: datetime, size: int = 0
) -> None:
    """Let a submitter have one more job, for a submission of that size [bytes].

    Raises
    ------
    QuotaError
        If that is too much.
    """
    count = sa.select(sa.func.count()).select_from(jobs).where(jobs.c.submitter == submitter)
    waiting = connection.scalar(count.where(jobs.c.ended_at.is_(None))) or 0
    if waiting >= quota.open:
        raise QuotaError(
            f"{submitter} has {waiting} submissions in the queue, at most {quota.open} "
            "may be: wait for one to end"
        )
    recent = (jobs.c.state == "failed") & (jobs.c.ended_at > now - quota.window)
    failed = connection.scalar(count.where(recent)) or 0
    if failed >= quota.failures:
        hours = quota.window / timedelta(hours=1)
        raise QuotaError(
            f"{failed} submissions of {submitter} have failed in the last {hours:g} hours, at "
            f"most {quota.failures} may: try 'colift check' first, and come back later"
        )
    done = (jobs.c.state == "done") & (jobs.c.ended_at > now - quota.window)
    rows = (connection.scalar(count.where(done)) or 0) + waiting
    if rows >= quota.rows:
        hours = quota.window / timedelta(hours=1)
        raise QuotaError(
            f"{submitter} has {rows} rows of the last {hours:g} hours or on the way, at most "
            f"{quota.rows} may be: choose by the public lifts (colift run), and come back later"
        )
    kept: int = connection.execute(_kept(submitter)).scalar() or 0
    if kept + size > quota.size:
        raise QuotaError(
            f"the board keeps {kept / MIB:.0f} MiB of {submitter}, this has {size / MIB:.0f} MiB, "
            f"and {quota.size // MIB} MiB may be kept in all: ask the maintainer of the board"
        )


def _kept(submitter: str) -> sa.Select[Any]:
    """Return the query for what is kept of a submitter [bytes]; seasons share equal contents."""
    each = (
        sa.select(sa.func.max(jobs.c.size).label("size"))
        .where(jobs.c.submitter == submitter)
        .group_by(jobs.c.submission)
        .subquery()
    )
    return sa.select(sa.func.sum(each.c.size))


NEVER: Final = datetime.min.replace(tzinfo=UTC)


def in_turn(
    waiting: Sequence[Mapping[str, Any]], held: Sequence[str], served: Mapping[str, datetime]
) -> Iterator[Mapping[str, Any]]:
    """Yield the jobs that wait in the order in which they are taken, if none ends meanwhile.

    First those of the submitter of whom fewest are worked on, then of the one who was not served
    for the longest time, and of one submitter the oldest.

    Parameters
    ----------
    waiting
        Rows of the table of jobs.
    held
        Submitters of the jobs that are worked on.
    served
        See :func:`last_served`.
    """
    left, running = list(waiting), Counter(held)

    def place(job: Mapping[str, Any]) -> tuple[int, datetime, datetime, str]:
        who = job["submitter"]
        return running[who], served.get(who, NEVER), job["submitted_at"], job["id"]

    while left:
        job = min(left, key=place)
        left.remove(job)
        yield job
        running[job["submitter"]] += 1


def last_served(connection: sa.Connection) -> dict[str, datetime]:
    """Return when a worker was last heard of that had a job of a submitter; not who never had."""
    query = sa.select(jobs.c.submitter, sa.func.max(jobs.c.heartbeat_at)).group_by(jobs.c.submitter)
    return {who: at for who, at in connection.execute(query) if at is not None}
