"""Response models of the API, as its OpenAPI document describes them.

Seasons, events and strata are returned as records, without a model of their own.
"""

from collections.abc import Mapping, Sequence
from datetime import datetime
from typing import Any, Self

from colift.benchmark.results.strata import StratumScore
from colift.leaderboard.core.standings import RankedRow, Section
from colift.leaderboard.records.job import Job, State
from colift.leaderboard.records.row import BoardRow
from colift.leaderboard.records.season import Event
from colift.leaderboard.views.page import PARTS
from pydantic import BaseModel, ConfigDict, Field


class Answer(BaseModel):
    """A model read from the board; the text below an attribute is its description."""

    model_config = ConfigDict(from_attributes=True, use_attribute_docstrings=True, frozen=True)

    @classmethod
    def of(cls, record: object, **more: Any) -> Self:
        """Return the published part of a record, with further values."""
        known: Mapping[str, Any] = vars(record) | more
        return cls(**{name: known[name] for name in cls.model_fields})


class Health(Answer):
    """The answer of a service whose database answers."""

    status: str = "ok"
    season: str
    """The season that takes submissions."""


class SubmitterAnswer(Answer):
    """The owner of a token."""

    submitter: str


class StandingAnswer(Answer):
    """A row, and its place in its season."""

    rank: int
    """Rank in its section over all hidden episodes: 1 + the number of policies that are better
    beyond chance; 0 is none."""
    pending: bool
    """Whether its rank is still being computed."""
    section: Section
    """The ranking, that of policies that are not real-time, or a section without ranks."""
    at: datetime
    """Time at which it was put on the board."""
    submitter: str
    row: BoardRow
    events: tuple[Event, ...]
    """Its later events, oldest first."""
    strata: Sequence[StratumScore] | None
    """The requested public lifts, by behaviour and subject; None if none were requested."""

    @classmethod
    def of_row(cls, standing: RankedRow, strata: Sequence[StratumScore] | None) -> Self:
        """Return the published part of a row."""
        return cls.of(standing, section=standing.section, strata=strata)


class EntryAnswer(Answer):
    """The outcome of a submission, which never changes."""

    season: str
    submission: str
    """Digest of its content."""
    submitter: str
    at: datetime
    row: BoardRow | None
    refusal: str | None
    """Reason for having no row."""
    events: tuple[Event, ...]
    bundle: str | None
    """Address of the bundle of its public run."""


class JobSummary(Answer):
    """A submission and its progress."""

    id: str = Field(pattern=f"^{PARTS['job']}$")
    season: str
    submission: str
    """Digest of its content."""
    name: str
    """Name of its policy."""
    submitted_at: datetime
    ended_at: datetime | None
    """Time at which it ended; after that, nothing more happens to it."""
    state: State
    stage: str | None
    """Present stage of the evaluation."""
    done: int
    """Number of finished episodes."""
    total: int
    """Total number of episodes."""
    reason: str | None
    """Reason of a failure, or of a new attempt."""


class JobAnswer(JobSummary):
    """The job of a submission."""

    submitter: str
    started_at: datetime | None
    heartbeat_at: datetime | None
    """Last heartbeat of its worker."""
    attempt: int
    """Number of times that it was begun."""
    log: str | None
    """Log of the workers."""
    unattended: str | None
    """That nobody evaluates at present, and since when no worker has been seen; null if one works
    for the board, or the job has ended."""


class SubmissionAnswer(JobSummary):
    """One of the submissions of the token's owner."""

    job: str
    """Address of its job."""
    entry: str | None
    """Address of its row, if it has one."""

    @classmethod
    def of_job(cls, job: Job, root: str) -> Self:
        """Return the part of a job that its submitter sees; ``root`` is the address of the API."""
        entry = f"{root}/entries/{job.season}/{job.submission}" if job.state == "done" else None
        return cls.of(job, job=f"{root}/jobs/{job.id}", entry=entry)


class RulesAnswer(Answer):
    """Limits of submissions, quotas, rules of publication, and the maintainer's contact."""

    season: str
    """The season that takes submissions."""
    suite: str
    upload_bytes: int
    """Largest zip archive."""
    files: int
    """Files and folders in a submission."""
    file_bytes: int
    """Largest file."""
    total_bytes: int
    """All files together."""
    packages: list[str]
    """Packages that a policy may import besides the standard library and `colift.agents`."""
    open_jobs: int
    """Submissions of one submitter that may wait at the same time."""
    failures: int
    """Submissions of one submitter that may fail within a window."""
    rows: int
    """Submissions of one submitter that may get a row within a window."""
    window_hours: float
    kept_bytes: int
    """Size of the files kept of all submissions of one submitter."""
    published: list[str]
    """Parts of a submission that everyone may see."""
    private: list[str]
    """Parts that only the maintainer sees."""
    contact: str | None
    """Contact of the maintainer of the board."""
