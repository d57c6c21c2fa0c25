"""Response models of the API, as its OpenAPI document describes them.

Seasons, events and strata are answered as the records that they are.
"""

from collections.abc import Mapping, Sequence
from datetime import datetime
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, Field

from ..board.standings import RankedRow, Section
from ..records.job import Job, State
from ..records.row import BoardRow
from ..records.season import Event
from ..views.lifts import StratumScore


class Answer(BaseModel):
    """Something read from the board; the texts below an attribute are its description."""

    model_config = ConfigDict(from_attributes=True, use_attribute_docstrings=True, frozen=True)

    @classmethod
    def of(cls, record: object, **more: Any) -> Self:
        """Return what is published of a record, and more beside it."""
        known: Mapping[str, Any] = vars(record) | more
        return cls(**{name: known[name] for name in cls.model_fields})


class Health(Answer):
    """The service answers, and so does its database."""

    status: str = "ok"
    season: str
    """The season that takes submissions."""


class SubmitterAnswer(Answer):
    """The owner of a token."""

    submitter: str


class StandingAnswer(Answer):
    """A row, and where it stands in its season."""

    group: int
    """Rank group in its section over all hidden episodes, 1 the best; 0 is none."""
    section: Section
    """The ranking, that of policies that are not real-time, or a section without ranks."""
    at: datetime
    """When it was put on the board."""
    submitter: str
    row: BoardRow
    events: tuple[Event, ...]
    """What has happened to it since, oldest first."""
    strata: Sequence[StratumScore] | None
    """The requested public lifts, by behaviour and subject; None if none were requested."""

    @classmethod
    def of_row(cls, standing: RankedRow, strata: Sequence[StratumScore] | None) -> Self:
        """Return what is published of a row."""
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
    """Why it has no row."""
    events: tuple[Event, ...]
    bundle: str | None
    """Address of the bundle of its public run."""


class JobSummary(Answer):
    """A submission and its progress."""

    id: str = Field(pattern="^[0-9a-f]{32}$")
    season: str
    submission: str
    """Digest of its content."""
    name: str
    """Name of its policy."""
    submitted_at: datetime
    ended_at: datetime | None
    """Nothing more happens to it after this."""
    state: State
    stage: str | None
    """What the worker does now."""
    done: int
    """Episodes that are finished."""
    total: int
    """Episodes in all."""
    reason: str | None
    """Why it failed, or is tried again."""


class JobAnswer(JobSummary):
    """The job of a submission."""

    submitter: str
    started_at: datetime | None
    heartbeat_at: datetime | None
    """Last heartbeat of its worker."""
    attempt: int
    """How often it was begun."""
    log: str | None
    """What the workers wrote about it."""


class SubmissionAnswer(JobSummary):
    """One of the submissions of the token's owner."""

    job: str
    """Address of its job."""
    entry: str | None
    """Address of its row, if it has one."""

    @classmethod
    def of_job(cls, job: Job, root: str) -> Self:
        """Return what is published of a job to its submitter; the API is at the root."""
        entry = f"{root}/entries/{job.season}/{job.submission}" if job.state == "done" else None
        return cls.of(job, job=f"{root}/jobs/{job.id}", entry=entry)


class RulesAnswer(Answer):
    """Limits of submissions, quotas, what is published, and the maintainer's contact."""

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
    """What a policy may import beside the standard library and `colift.agents`."""
    open_jobs: int
    """Submissions of one submitter that may wait at the same time."""
    failures: int
    """Submissions of one submitter that may fail within a window."""
    rows: int
    """Submissions of one submitter that may get a row within a window."""
    window_hours: float
    kept_bytes: int
    """What is kept of all submissions of one submitter."""
    published: list[str]
    """What everybody may see of a submission."""
    private: list[str]
    """What nobody but the maintainer sees."""
    contact: str | None
    """How the maintainer of the board is reached."""
