"""The queue, and who may put something into it."""

import sqlalchemy as sa
from alembic import op
from colift.leaderboard.database.schema import Time

revision = "0002"
down_revision = "0001"


def upgrade() -> None:
    """Make the tables of jobs and tokens."""
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
