"""The tables.

The record is append-only: ``seasons``, ``entries``, ``hidden_errors`` and ``events`` only
grow, and triggers in the database refuse anything else (:func:`.protect`). ``jobs``, ``workers``
and ``tokens`` change state. ``rank_groups`` can be thrown away: it is computed from the others. A
change of the tables is a new revision in ``migrations/versions``; older ones stay as they are.
"""

from datetime import UTC, datetime
from typing import Any, Final

import sqlalchemy as sa
from sqlalchemy.engine import Dialect


class Time(sa.TypeDecorator[datetime]):
    """A time with its zone; SQLite, which has no zones, keeps it in UTC."""

    impl = sa.DateTime(timezone=True)
    cache_ok = True

    def process_bind_param(self, value: datetime | None, dialect: Dialect) -> datetime | None:
        """Return the time in UTC."""
        return None if value is None else value.astimezone(UTC)

    def process_result_value(self, value: Any, dialect: Dialect) -> datetime | None:
        """Return the time with its zone, UTC."""
        if value is None:
            return None
        time: datetime = value
        return time.replace(tzinfo=UTC) if time.tzinfo is None else time.astimezone(UTC)


JSON: Final = sa.JSON(none_as_null=True)

metadata: Final = sa.MetaData()

seasons: Final = sa.Table(
    "seasons",
    metadata,
    sa.Column("number", sa.Integer, primary_key=True),
    sa.Column("name", sa.String(40), nullable=False, unique=True),
    sa.Column("suite", sa.Text, nullable=False),
    sa.Column("suite_digest", sa.Text, nullable=False),
    sa.Column("commitment", sa.String(64), nullable=False),
    sa.Column("began_at", Time, nullable=False),
    # Whether it ever took submissions here; the last such season is the current one.
    sa.Column("taking", sa.Boolean, nullable=False),
)

entries: Final = sa.Table(
    "entries",
    metadata,
    sa.Column("number", sa.Integer, primary_key=True),
    sa.Column("season", sa.ForeignKey("seasons.name"), nullable=False),
    sa.Column("submission", sa.String(64), nullable=False),
    sa.Column("name", sa.Text, nullable=False, index=True),
    sa.Column("submitter", sa.Text, nullable=False),
    sa.Column("at", Time, nullable=False),
    sa.Column("row", JSON),
    sa.Column("refusal", sa.Text),
    sa.UniqueConstraint("season", "submission"),
)

hidden_errors: Final = sa.Table(
    "hidden_errors",
    metadata,
    sa.Column("number", sa.Integer, primary_key=True),
    sa.Column("season", sa.ForeignKey("seasons.name"), nullable=False),
    sa.Column("submission", sa.String(64), nullable=False),
    # RMSE of each hidden episode [mm], little-endian float64. Never published.
    sa.Column("rmse_mm", sa.LargeBinary, nullable=False),
    sa.Index("ix_hidden_errors_of", "season", "submission"),
)

events: Final = sa.Table(
    "events",
    metadata,
    sa.Column("number", sa.Integer, primary_key=True),
    sa.Column("at", Time, nullable=False),
    sa.Column("who", sa.Text, nullable=False),
    sa.Column("kind", sa.Text, nullable=False),
    sa.Column("why", sa.Text, nullable=False),
    sa.Column("season", sa.ForeignKey("seasons.name"), nullable=False),
    sa.Column("submission", sa.String(64)),
    sa.Column("content", JSON),
    sa.Index("ix_events_of", "season", "submission"),
)

jobs: Final = sa.Table(
    "jobs",
    metadata,
    sa.Column("id", sa.String(32), primary_key=True),
    sa.Column("season", sa.ForeignKey("seasons.name"), nullable=False),
    sa.Column("submission", sa.String(64), nullable=False),
    sa.Column("name", sa.Text, nullable=False),
    sa.Column("submitter", sa.Text, nullable=False, index=True),
    sa.Column("state", sa.Text, nullable=False, index=True),
    sa.Column("stage", sa.Text),
    sa.Column("done", sa.Integer, nullable=False),
    sa.Column("total", sa.Integer, nullable=False),
    sa.Column("submitted_at", Time, nullable=False),
    sa.Column("started_at", Time),
    sa.Column("heartbeat_at", Time),
    sa.Column("ended_at", Time),
    # The job is not taken before this time.
    sa.Column("ready_at", Time, nullable=False),
    sa.Column("worker", sa.Text),
    sa.Column("attempt", sa.Integer, nullable=False),
    sa.Column("faults", sa.Integer, nullable=False),
    sa.Column("lost", sa.Integer, nullable=False),
    sa.Column("reason", sa.Text),
    # Of the submission's files [bytes].
    sa.Column("size", sa.Integer, nullable=False, server_default="0"),
    sa.UniqueConstraint("season", "submission"),
)

workers: Final = sa.Table(
    "workers",
    metadata,
    sa.Column("name", sa.Text, primary_key=True),
    # When it last waited for a job.
    sa.Column("seen_at", Time, nullable=False),
    # Whether it has said that it takes no more jobs.
    sa.Column("ended", sa.Boolean, nullable=False),
)

tokens: Final = sa.Table(
    "tokens",
    metadata,
    sa.Column("number", sa.Integer, primary_key=True),
    sa.Column("name", sa.Text, nullable=False),
    sa.Column("sha256", sa.String(64), nullable=False, unique=True),
    sa.Column("added_at", Time, nullable=False),
    sa.Column("revoked_at", Time),
)

rank_groups: Final = sa.Table(
    "rank_groups",
    metadata,
    sa.Column("season", sa.ForeignKey("seasons.name"), primary_key=True),
    # Of the errors that the groups were computed from.
    sa.Column("fingerprint", sa.String(64), primary_key=True),
    sa.Column("groups", JSON, nullable=False),
)

APPEND_ONLY: Final = ("seasons", "entries", "hidden_errors", "events")
"""Tables that only grow."""
