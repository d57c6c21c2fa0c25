"""What the API answers: the shapes that its OpenAPI document describes."""

from collections.abc import Mapping, Sequence
from datetime import datetime
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, Field

from ..entry import Entry
from ..event import Event, Kind
from ..job import Job, State
from ..row import Row
from ..season import SeasonInfo
from ..standing import Standing
from ..views.lifts import CellScore


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


class CellAnswer(Answer):
    """Means over the public lifts of one behaviour with one subject."""

    behaviour: str
    subject: str
    episodes: int
    failed: int
    rmse_mm: float
    team_rmse_mm: float | None
    """The human-human team's."""
    sparc: float | None
    human_force_n: float | None


class StandingAnswer(Answer):
    """A row, and where it stands in its season."""

    group: int
    """Rank group over all hidden episodes, 1 the best; 0 is out of the ranking."""
    at: datetime
    """When it was put on the board."""
    submitter: str
    row: Row
    events: list[EventAnswer]
    """What has happened to it since, oldest first."""
    cells: list[CellAnswer] | None
    """The public lifts asked for, by behaviour and subject; nothing if none were."""

    @classmethod
    def of(cls, standing: Standing, cells: Sequence[CellScore] | None) -> Self:
        """Return what is told of a row."""
        return cls(
            group=standing.group,
            at=standing.at,
            submitter=standing.submitter,
            row=standing.row,
            events=[EventAnswer.of(event) for event in standing.events],
            cells=None if cells is None else [CellAnswer.model_validate(cell) for cell in cells],
        )


class EntryAnswer(Answer):
    """What the board says of a submission, for good."""

    season: str
    submission: str
    """Digest of its content."""
    submitter: str
    at: datetime
    row: Row | None
    refusal: str | None
    """Why it has no row."""
    events: list[EventAnswer]
    bundle: str | None
    """Where the bundle of its public run is."""

    @classmethod
    def of(cls, entry: Entry, events: Sequence[Event], bundle: str | None) -> Self:
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


def _dict(content: Mapping[str, Any] | None) -> dict[str, Any] | None:
    return None if content is None else dict(content)
