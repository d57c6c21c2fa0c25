"""Jobs: the evaluation of a submission, from the queue to its row."""

from dataclasses import dataclass
from datetime import datetime
from typing import Any, Final, Literal

State = Literal["queued", "running", "verifying", "done", "failed", "evaluator fault", "cancelled"]
"""An ``evaluator fault`` is a fault of this machine: until the job has ended, it is tried again."""

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
"""States in which a worker has the job."""


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
    """Number of finished episodes."""
    total: int
    """Total number of episodes."""
    submitted_at: datetime
    started_at: datetime | None
    heartbeat_at: datetime | None
    ended_at: datetime | None
    worker: str | None
    attempt: int
    """Number of times that it was begun."""
    reason: str | None
    """Reason of a failure, or of a new attempt."""
    log: str | None
    """Log of the workers."""

    @property
    def ended(self) -> bool:
        """Whether nothing more will happen to it."""
        return self.ended_at is not None

    def plain(self) -> dict[str, Any]:
        """Return the job as JSON."""
        return {
            name: value.isoformat() if isinstance(value, datetime) else value
            for name, value in vars(self).items()
        }
