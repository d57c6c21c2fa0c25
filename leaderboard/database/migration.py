"""Creation and migration of the tables."""

from importlib.resources import as_file, files
from typing import Final

import sqlalchemy as sa

from ...agents.errors import InputError
from .transactions import reading, writing

HEAD: Final = "0001"
"""The last revision: that of :mod:`.schema`."""


def migrate(engine: sa.Engine, shown: str) -> None:
    """Bring a database to the last revision, in one transaction.

    Parameters
    ----------
    engine
        The database.
    shown
        Its name in errors.

    Raises
    ------
    InputError
        If the tables are those of a later colift.
    """
    with reading(engine) as connection:
        if _revision(connection) == HEAD:
            return
    with writing(engine) as connection:
        _run(connection, shown)


def _run(connection: sa.Connection, shown: str) -> None:
    from alembic import command
    from alembic.config import Config
    from alembic.util import CommandError

    with as_file(files(__package__).joinpath("migrations")) as scripts:
        config = Config()
        config.set_main_option("script_location", str(scripts).replace("%", "%%"))
        config.set_main_option("path_separator", "os")
        config.attributes["connection"] = connection
        try:
            command.upgrade(config, HEAD)
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


_FUNCTION: Final = """
CREATE OR REPLACE FUNCTION colift_append_only() RETURNS trigger AS $$
BEGIN RAISE EXCEPTION '% is append-only', TG_TABLE_NAME; END;
$$ LANGUAGE plpgsql
"""

_POSTGRESQL: Final = """
CREATE TRIGGER {table}_append_only BEFORE UPDATE OR DELETE OR TRUNCATE ON {table}
FOR EACH STATEMENT EXECUTE FUNCTION colift_append_only()
"""

_SQLITE: Final = """
CREATE TRIGGER {table}_no_{what} BEFORE {what} ON {table}
BEGIN SELECT RAISE(ABORT, '{table} is append-only'); END
"""


def protect(connection: sa.Connection, table: str) -> None:
    """Make a table refuse changes and removals of its rows."""
    if connection.dialect.name == "postgresql":
        connection.exec_driver_sql(_FUNCTION.replace("%", "%%"))
        connection.exec_driver_sql(_POSTGRESQL.format(table=table))
    else:
        for what in ("UPDATE", "DELETE"):
            connection.exec_driver_sql(_SQLITE.format(table=table, what=what))
