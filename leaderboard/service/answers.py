"""Response models of the API, as its OpenAPI document describes them."""

from collections.abc import Mapping, Sequence
from datetime import datetime
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, Field

from ...benchmark.statistics import MeanWithMissing
from ..board.standings import RankedRow, Section
from ..records.job import Job, State
from ..records.row import BoardRow
from ..records.season import BoardEntry, Event, Kind, SeasonInfo
from ..views.lifts import StratumScore


class Answer(BaseModel):
    """Something read from the board; the texts below an attribute are its description."""

    model_config = ConfigDict(from_attributes=True, use_attribute_docstrings=True, frozen=True)


class Health(Answer):
    """The service answers, and so does its database."""

    status: str = "ok"
    season: str
    """The season that takes submissions."""


class SubmitterAnswer(Answer):
    """Who a token belongs to."""

    submitter: str


class SeasonAnswer(Answer):
    """A season: one suite, one secret, one table."""

    name: str
    suite: str
    suite_digest: str
    commitment: str
    """SHA-256 of the secret that the hidden episodes follow from."""
    began_at: datetime
    current: bool
    """Whether it takes submissions; all others are frozen."""
    revealed: str | None
    """The secret, 64 hexadecimal digits, if it has been published."""

    @classmethod
    def of(cls, season: SeasonInfo) -> Self:
        """Return what is told of a season."""
        return cls.model_validate(season)


class EventAnswer(Answer):
    """What was done to a season, or to a submission in it: by whom, when and why."""

    at: datetime
    who: str
    kind: Kind
    why: str
    content: dict[str, Any] | None
    """What belongs to it, such as the row of a rescore."""

    @classmethod
    def of(cls, event: Event) -> Self:
        """Return what is told of an event."""
        return cls.model_validate({**vars(event), "content": _dict(event.content)})


class StratumAnswer(Answer):
    """Means over the public lifts of one behaviour with one subject."""

    behaviour: str
    subject: str
    episodes: int
    failed: int
    rmse_mm: float
    team_rmse_mm: float | None
    """The human-human team's."""
    metrics: Mapping[str, MeanWithMissing]
    """The other metrics of the board, by name."""


class StandingAnswer(Answer):
    """A row, and where it stands in its season."""

    group: int
    """Rank group in its section over all hidden episodes, 1 the best; 0 is none."""
    section: Section
    """The ranking, that of what is not real-time, or where there are no ranks."""
    at: datetime
    """When it was put on the board."""
    submitter: str
    row: BoardRow
    events: list[EventAnswer]
    """What has happened to it since, oldest first."""
    strata: list[StratumAnswer] | None
    """The public lifts asked for, by behaviour and subject; nothing if none were."""

    @classmethod
    def of(cls, standing: RankedRow, strata: Sequence[StratumScore] | None) -> Self:
        """Return what is told of a row."""
        return cls(
            group=standing.group,
            section=standing.section,
            at=standing.at,
            submitter=standing.submitter,
            row=standing.row,
            events=[EventAnswer.of(event) for event in standing.events],
            strata=None
            if strata is None
            else [StratumAnswer.model_validate(stratum) for stratum in strata],
        )


class EntryAnswer(Answer):
    """What the board says of a submission, for good."""

    season: str
    submission: str
    """Digest of its content."""
    submitter: str
    at: datetime
    row: BoardRow | None
    refusal: str | None
    """Why it has no row."""
    events: list[EventAnswer]
    bundle: str | None
    """Where the bundle of its public run is."""

    @classmethod
    def of(cls, entry: BoardEntry, events: Sequence[Event], bundle: str | None) -> Self:
        """Return what is told of an entry."""
        return cls(
            season=entry.season,
            submission=entry.submission,
            submitter=entry.submitter,
            at=entry.at,
            row=entry.row,
            refusal=entry.refusal,
            events=[EventAnswer.of(event) for event in events],
            bundle=bundle,
        )


class JobAnswer(Answer):
    """A submission on its way to a row."""

    id: str = Field(pattern="^[0-9a-f]{32}$")
    season: str
    submission: str
    """Digest of its content."""
    name: str
    """What its policy is called."""
    submitter: str
    state: State
    stage: str | None
    """What the worker does now."""
    done: int
    total: int
    """Episodes that are finished, of so many."""
    submitted_at: datetime
    started_at: datetime | None
    heartbeat_at: datetime | None
    """When its worker was heard of last."""
    ended_at: datetime | None
    """Nothing more will happen to it after this."""
    attempt: int
    """How often it was begun."""
    reason: str | None
    """Why it failed, or is tried again."""
    log: str | None
    """What the workers wrote of it."""

    @classmethod
    def of(cls, job: Job) -> Self:
        """Return what is told of a job."""
        return cls.model_validate(job)


class SubmissionAnswer(Answer):
    """One of the submissions of whoever asks."""

    name: str
    """What its policy is called."""
    season: str
    submission: str
    """Digest of its content."""
    submitted_at: datetime
    ended_at: datetime | None
    state: State
    stage: str | None
    """What the worker does now."""
    done: int
    total: int
    """Episodes that are finished, of so many."""
    reason: str | None
    """Why it failed, or is tried again."""
    id: str = Field(pattern="^[0-9a-f]{32}$")
    """Its job's."""
    job: str
    """Where its job is."""
    entry: str | None
    """Where its row is, if it has one."""

    @classmethod
    def of(cls, job: Job, root: str) -> Self:
        """Return what is told of a job to its submitter; the API is at the root."""
        place = f"{root}/entries/{job.season}/{job.submission}"
        told = {key: value for key, value in vars(job).items() if key in cls.model_fields}
        entry = place if job.state == "done" else None
        return cls(**told, job=f"{root}/jobs/{job.id}", entry=entry)


class RulesAnswer(Answer):
    """What a submission may be, what becomes of it, and who answers for the board."""

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


def _dict(content: Mapping[str, Any] | None) -> dict[str, Any] | None:
    return None if content is None else dict(content)
