"""Rank groups as they were computed, so that nobody who looks at the board waits for them."""

import sqlalchemy as sa
from alembic import op
from colift.leaderboard.database.schema import JSON

revision = "0003"
down_revision = "0002"


def upgrade() -> None:
    """Make the table of rank groups."""
    op.create_table(
        "rank_groups",
        sa.Column("season", sa.String(40), sa.ForeignKey("seasons.name"), primary_key=True),
        sa.Column("fingerprint", sa.String(64), primary_key=True),
        sa.Column("groups", JSON, nullable=False),
    )
