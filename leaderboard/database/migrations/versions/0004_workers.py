"""The signatures of the workers that wait for jobs.

The numbers 0002 and 0003 were those of development versions, and are not used again.
"""

import sqlalchemy as sa
from alembic import op
from colift.leaderboard.database.schema import Time

revision = "0004"
down_revision = "0001"


def upgrade() -> None:
    """Create the table of workers."""
    op.create_table(
        "workers",
        sa.Column("name", sa.Text, primary_key=True),
        sa.Column("seen_at", Time, nullable=False),
        sa.Column("ended", sa.Boolean, nullable=False),
    )
