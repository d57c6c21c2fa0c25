"""Quotas of submitters, and the order in which they are served."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from typing import Any, Final

import sqlalchemy as sa
from colift.agents.submissions.folder import MIB
from colift.base.errors import InputError
from colift.leaderboard.database.schema import jobs


class QuotaError(InputError):
    """A submitter exceeds the quota of open jobs, rows, stored files or failures."""


@dataclass(frozen=True, kw_only=True)
class Quota:
    """The limits of a submitter."""

    open: int = 5
    """Jobs that have not ended."""
    failures: int = 20
    """Jobs that failed within a window, without evaluator faults."""
    rows: int = 10
    """Jobs that got a row within a window, including those that may still get one: each row reveals
    a little about the hidden lifts."""
    window: timedelta = timedelta(days=1)
    size: int = 2048 * MIB
    """Size of all files that are kept of a submitter [bytes]."""


NO_QUOTA: Final = Quota(open=10**9, failures=10**9, rows=10**9, size=10**18)
"""The quota of a user who can write to the board's folder anyway."""


def admit(
    connection: sa.Connection, submitter: str, quota: Quota, now: datetime, size: int = 0
) -> None:
    """Check that a submitter may have one more job, for a submission of that size [bytes].

    Raises
    ------
    QuotaError
        If the quota would be exceeded.
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
    """Return the query for the size kept of a submitter [bytes]; seasons share equal contents."""
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
    """Yield the waiting jobs in the order in which they are taken, if none ends meanwhile.

    The submitter with the fewest running jobs comes first, of several the one who was served
    longest ago; of the jobs of one submitter, the oldest.

    Parameters
    ----------
    waiting
        Rows of the table of jobs.
    held
        Submitters of the running jobs.
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
    """Return the last heartbeat of a worker on a job of each submitter who was ever served."""
    query = sa.select(jobs.c.submitter, sa.func.max(jobs.c.heartbeat_at)).group_by(jobs.c.submitter)
    return {who: at for who, at in connection.execute(query) if at is not None}
