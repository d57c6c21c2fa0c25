"""Creation and migration of the tables."""

from importlib.resources import as_file, files
from typing import Final

import sqlalchemy as sa
from colift.base.errors import InputError
from colift.leaderboard.database.schema import metadata
from colift.leaderboard.database.transactions import reading, writing

HEAD: Final = "0004"
"""The last revision: that of :mod:`.schema`."""

RETIRED: Final = ("0002", "0003")
"""Revisions of development versions before the first release; their numbers are not used again."""


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
        If the tables are those of a later colift, or of none.
    """
    with reading(engine) as connection:
        there = set(sa.inspect(connection).get_table_names())
        if _revision(connection) == HEAD and there >= set(metadata.tables):
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
            raise InputError(_unknown(shown, _revision(connection))) from error
    missing = _missing(connection)
    if missing:
        raise InputError(
            f"database {shown} lacks {missing[0]}: its tables are those of a development version "
            "before the first release, which no release reads; make a new board"
        )


def _unknown(shown: str, revision: str | None) -> str:
    """Return why tables of a revision cannot be used, and which colift can."""
    found = f"database {shown} has revision {revision}"
    if revision in RETIRED:
        return (
            f"{found}, of a development version before the first release, which no release reads; "
            "make a new board"
        )
    return (
        f"{found}, this colift knows up to {HEAD}: a later colift made it; use that one, or one "
        "after it"
    )


def _missing(connection: sa.Connection) -> list[str]:
    """Return the tables and columns of the schema that a database lacks."""
    found = sa.inspect(connection)
    missing = []
    for table in metadata.sorted_tables:
        there = found.has_table(table.name)
        known = {each["name"] for each in found.get_columns(table.name)} if there else set()
        missing += [f"{table.name}.{each.name}" for each in table.c if each.name not in known]
    return missing


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
