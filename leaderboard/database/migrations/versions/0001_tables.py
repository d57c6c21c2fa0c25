"""The tables of the first release, as they were: later changes are revisions of their own."""

import sqlalchemy as sa
from alembic import op
from colift.leaderboard.database.migration import protect
from colift.leaderboard.database.schema import JSON, Time

revision = "0001"
down_revision = None


def upgrade() -> None:
    """Create the tables, and protect those that only grow."""
    op.create_table(
        "seasons",
        sa.Column("number", sa.Integer, primary_key=True),
        sa.Column("name", sa.String(40), nullable=False, unique=True),
        sa.Column("suite", sa.Text, nullable=False),
        sa.Column("suite_digest", sa.Text, nullable=False),
        sa.Column("commitment", sa.String(64), nullable=False),
        sa.Column("began_at", Time, nullable=False),
        sa.Column("taking", sa.Boolean, nullable=False),
    )
    op.create_table(
        "entries",
        sa.Column("number", sa.Integer, primary_key=True),
        sa.Column("season", sa.String(40), sa.ForeignKey("seasons.name"), nullable=False),
        sa.Column("submission", sa.String(64), nullable=False),
        sa.Column("name", sa.Text, nullable=False, index=True),
        sa.Column("submitter", sa.Text, nullable=False),
        sa.Column("at", Time, nullable=False),
        sa.Column("row", JSON),
        sa.Column("refusal", sa.Text),
        sa.UniqueConstraint("season", "submission"),
    )
    op.create_table(
        "hidden_errors",
        sa.Column("number", sa.Integer, primary_key=True),
        sa.Column("season", sa.String(40), sa.ForeignKey("seasons.name"), nullable=False),
        sa.Column("submission", sa.String(64), nullable=False),
        sa.Column("rmse_mm", sa.LargeBinary, nullable=False),
        sa.Index("ix_hidden_errors_of", "season", "submission"),
    )
    op.create_table(
        "events",
        sa.Column("number", sa.Integer, primary_key=True),
        sa.Column("at", Time, nullable=False),
        sa.Column("who", sa.Text, nullable=False),
        sa.Column("kind", sa.Text, nullable=False),
        sa.Column("why", sa.Text, nullable=False),
        sa.Column("season", sa.String(40), sa.ForeignKey("seasons.name"), nullable=False),
        sa.Column("submission", sa.String(64)),
        sa.Column("content", JSON),
        sa.Index("ix_events_of", "season", "submission"),
    )
    op.create_table(
        "jobs",
        sa.Column("id", sa.String(32), primary_key=True),
        sa.Column("season", sa.String(40), sa.ForeignKey("seasons.name"), nullable=False),
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
        sa.Column("ready_at", Time, nullable=False),
        sa.Column("worker", sa.Text),
        sa.Column("attempt", sa.Integer, nullable=False),
        sa.Column("faults", sa.Integer, nullable=False),
        sa.Column("lost", sa.Integer, nullable=False),
        sa.Column("reason", sa.Text),
        sa.Column("size", sa.Integer, nullable=False, server_default="0"),
        sa.UniqueConstraint("season", "submission"),
    )
    op.create_table(
        "tokens",
        sa.Column("number", sa.Integer, primary_key=True),
        sa.Column("name", sa.Text, nullable=False),
        sa.Column("sha256", sa.String(64), nullable=False, unique=True),
        sa.Column("added_at", Time, nullable=False),
        sa.Column("revoked_at", Time),
    )
    op.create_table(
        "rank_groups",
        sa.Column("season", sa.String(40), sa.ForeignKey("seasons.name"), primary_key=True),
        sa.Column("fingerprint", sa.String(64), primary_key=True),
        sa.Column("groups", JSON, nullable=False),
    )
    for table in ("seasons", "entries", "hidden_errors", "events"):
        protect(op.get_bind(), table)
