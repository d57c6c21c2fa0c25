"""The tables of the first release: those of the schema, as long as no release has others."""

from alembic import op
from colift.leaderboard.database.migration import protect
from colift.leaderboard.database.schema import APPEND_ONLY, metadata

revision = "0001"
down_revision = None


def upgrade() -> None:
    """Create the tables, and protect those that only grow."""
    metadata.create_all(op.get_bind())
    for table in APPEND_ONLY:
        protect(op.get_bind(), table)
