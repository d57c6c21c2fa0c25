"""Check of the tables of a backup: all that a board would read from them is read."""

import msgspec
import sqlalchemy as sa
from colift.leaderboard.database.connection import Database
from colift.leaderboard.database.queries import (
    legible,
    read_entries,
    read_error_numbers,
    read_errors,
    read_events,
    read_seasons,
)
from colift.leaderboard.database.schema import metadata
from colift.leaderboard.records.row import BoardRow
from colift.leaderboard.storage.damage import DamagedError


def check_tables(database: Database) -> None:
    """Raise DamagedError with the first damage of an SQLite database, if there is one."""
    with database.reading() as connection:
        _check_file(connection)
        for table in metadata.sorted_tables:
            with legible(f"the table {table.name}"):
                for row in connection.execute(sa.select(table)).mappings():
                    _check_row(table, row)
        for event in read_events(connection):
            if event.kind == "rescore":
                with legible(f"an event of season {event.season}"):
                    BoardRow.read((event.content or {})["row"])
        _check_entries(connection)


def _check_entries(connection: sa.Connection) -> None:
    """Check each entry, and that the errors of its hidden episodes are there."""
    found = read_entries(connection)
    numbers = {
        each.name: read_error_numbers(connection, each.name) for each in read_seasons(connection)
    }
    for entry in found:
        where = f"the entry {entry.submission} of season {entry.season}"
        if entry.row is None:
            continue
        number = numbers[entry.season].get(entry.submission)
        if number is None:
            raise DamagedError(f"{where} has no errors of its hidden episodes")
        read_errors(connection, entry.season, {entry.submission: number})


def _check_file(connection: sa.Connection) -> None:
    told = connection.exec_driver_sql("PRAGMA integrity_check(1)").scalar_one()
    if told != "ok":
        raise DamagedError(f"its database is damaged: {told}")
    strange = connection.exec_driver_sql("PRAGMA foreign_key_check").first()
    if strange is not None:
        raise DamagedError(
            f"its table {strange[0]} refers to a row that {strange[2]} does not have"
        )


def _check_row(table: sa.Table, row: sa.RowMapping) -> None:
    """Check the types of a row: SQLite keeps whatever it is given."""
    for column in table.c:
        value = row[column.name]
        if isinstance(column.type, sa.JSON) or (value is None and column.nullable):
            continue
        with legible(f"{value!a:.60} as {column.name} in the table {table.name}"):
            msgspec.convert(value, column.type.python_type)
