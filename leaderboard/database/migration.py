"""Brings the tables of a database to what this colift needs, whatever they are."""

from importlib.resources import as_file, files
from typing import Final

import sqlalchemy as sa

from ...agents.errors import InputError
from .transactions import reading, writing

HEAD: Final = "0003"
"""The last revision: that of :mod:`.schema`."""


def upgrade(engine: sa.Engine, shown: str, revision: str = HEAD) -> None:
    """Bring a database to a revision, in one transaction.

    Parameters
    ----------
    engine
        The database.
    shown
        What a user calls it.
    revision
        How far.

    Raises
    ------
    InputError
        If the tables are those of a later colift.
    """
    with reading(engine) as connection:
        if _revision(connection) == revision:
            return
    with writing(engine) as connection:
        _run(connection, shown, revision)


def _run(connection: sa.Connection, shown: str, revision: str) -> None:
    from alembic import command
    from alembic.config import Config
    from alembic.util import CommandError

    with as_file(files(__package__).joinpath("migrations")) as scripts:
        config = Config()
        config.set_main_option("script_location", str(scripts).replace("%", "%%"))
        config.set_main_option("path_separator", "os")
        config.attributes["connection"] = connection
        try:
            command.upgrade(config, revision)
        except CommandError as error:
            raise InputError(
                f"database {shown} has revision {_revision(connection)}, this colift knows up to "
                f"{HEAD}: use the colift that made it, or a later one"
            ) from error


def _revision(connection: sa.Connection) -> str | None:
    """Return the revision of the tables, or None if there are none."""
    if not sa.inspect(connection).has_table("alembic_version"):
        return None
    found: str | None = connection.scalar(sa.text("SELECT version_num FROM alembic_version"))
    return found
