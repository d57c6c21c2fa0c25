"""Jobs: the evaluation of a submission, from the queue to its row."""

from dataclasses import dataclass
from datetime import datetime
from typing import Any, Final, Literal

State = Literal["queued", "running", "verifying", "done", "failed", "evaluator fault", "cancelled"]
"""An ``evaluator fault`` is this machine's: as long as the job has not ended, it is tried again."""

STATES: Final[tuple[State, ...]] = (
    "queued",
    "running",
    "verifying",
    "done",
    "failed",
    "evaluator fault",
    "cancelled",
)

HELD: Final[tuple[State, ...]] = ("running", "verifying")
"""States in which a worker has it."""


@dataclass(frozen=True, kw_only=True)
class Job:
    """The job of a submission."""

    id: str
    """32 hexadecimal digits."""
    season: str
    submission: str
    """Digest of its content."""
    name: str
    """Name of its policy."""
    submitter: str
    state: State
    stage: str | None
    """Stage of the evaluation; see :data:`.progress.Stage`."""
    done: int
    """Episodes that are finished."""
    total: int
    """Episodes in all."""
    submitted_at: datetime
    started_at: datetime | None
    heartbeat_at: datetime | None
    ended_at: datetime | None
    worker: str | None
    attempt: int
    """How often it was begun."""
    reason: str | None
    """Why it failed, or is tried again."""
    log: str | None
    """What the workers wrote about it."""

    @property
    def ended(self) -> bool:
        """Whether nothing more will happen to it."""
        return self.ended_at is not None

    def plain(self) -> dict[str, Any]:
        """Return the job as JSON has it."""
        return {
            name: value.isoformat() if isinstance(value, datetime) else value
            for name, value in vars(self).items()
        }
