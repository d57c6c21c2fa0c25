"""How much a submitter may ask for."""

from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Final

import sqlalchemy as sa

from ...agents.errors import InputError
from ..database.schema import jobs


class QuotaError(InputError):
    """A submitter has too much in the queue, or has failed too often."""


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


def admit(connection: sa.Connection, submitter: str, quota: Quota, now: datetime) -> None:
    """Let a submitter have one more job.

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
