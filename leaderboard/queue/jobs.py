"""A job as the database has it."""

from datetime import datetime
from typing import Any, Final

from ..entry import Entry
from ..job import Job
from ..store import Store

REASON: Final = 2000
"""So many characters of a reason are kept."""


def read_job(found: Any, store: Store) -> Job:
    """Return the job that a row of the table is, with its log."""
    own = {name: value for name, value in found.items() if name in Job.__dataclass_fields__}
    return Job(**own, log=store.log(found["id"]))


def outcome(entry: Entry, ended_at: datetime) -> dict[str, Any]:
    """Return what a job is after its entry was made."""
    content: dict[str, Any] = {"state": "done", "reason": None, "ended_at": ended_at}
    if entry.row is None:
        content |= {"state": "failed", "reason": clean(entry.refusal or "refused")}
    return content


def clean(reason: str) -> str:
    """Return a reason as any database keeps it: no NUL, no half characters, not too long."""
    text = reason.replace("\0", "").encode(errors="replace").decode()
    return text if len(text) <= REASON else f"{text[: REASON - 3]}..."
