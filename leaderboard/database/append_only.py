"""Triggers that let a table only grow, whoever writes to it."""

from typing import Final

import sqlalchemy as sa

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
    """Make a table refuse every change and removal of a row."""
    if connection.dialect.name == "postgresql":
        connection.exec_driver_sql(_FUNCTION.replace("%", "%%"))
        connection.exec_driver_sql(_POSTGRESQL.format(table=table))
    else:
        for what in ("UPDATE", "DELETE"):
            connection.exec_driver_sql(_SQLITE.format(table=table, what=what))
