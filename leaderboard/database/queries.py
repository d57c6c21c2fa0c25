"""Queries that read, add and copy the records of a board."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, Final

import msgspec
import numpy as np
import sqlalchemy as sa
from colift.base.errors import error_text
from colift.leaderboard.database.schema import entries, events, hidden_errors, metadata, seasons
from colift.leaderboard.records.season import BoardEntry, Event, SeasonInfo
from colift.leaderboard.storage.damage import DAMAGE, DamagedError

Errors = np.ndarray[tuple[int], np.dtype[np.float64]]
"""RMSE of each hidden episode [mm]."""


@contextmanager
def legible(what: str) -> Iterator[None]:
    """Raise the many errors of damaged records as a DamagedError."""
    try:
        yield
    except DAMAGE as error:
        raise DamagedError(
            f"{what} of the board cannot be read ({error_text(error)}): its database is damaged; "
            "restore an earlier backup"
        ) from error


@legible("a season")
def read_seasons(connection: sa.Connection) -> tuple[SeasonInfo, ...]:
    """Return all seasons, oldest first."""
    found = connection.execute(sa.select(seasons).order_by(seasons.c.number)).all()
    current = next((each.name for each in reversed(found) if each.taking), None)
    revealed = {
        event.season: (event.content or {})["secret"]
        for event in read_events(connection, events.c.kind == "revelation")
    }
    return tuple(
        msgspec.convert(
            _plain(each._mapping)
            | {"current": each.name == current, "revealed": revealed.get(each.name)},
            SeasonInfo,
        )
        for each in found
    )


def _plain(row: sa.RowMapping) -> dict[str, Any]:
    """Return a row by names that are plain texts."""
    return {str(name): value for name, value in row.items()}


def read_entries(
    connection: sa.Connection, *conditions: sa.ColumnElement[bool]
) -> tuple[BoardEntry, ...]:
    """Return the entries for which all conditions hold, oldest first."""
    columns = [column for column in entries.c if column.name != "number"]
    query = sa.select(*columns).where(*conditions).order_by(entries.c.number)
    with legible("an entry"):
        return tuple(map(_entry, connection.execute(query).mappings()))


def _entry(found: sa.RowMapping) -> BoardEntry:
    with legible(f"the entry of {found['name']!a} in season {found['season']!a}"):
        return BoardEntry.read(_plain(found))


@legible("an event")
def read_events(
    connection: sa.Connection, *conditions: sa.ColumnElement[bool], newest: int | None = None
) -> tuple[Event, ...]:
    """Return the events for which all conditions hold, oldest first.

    With a number, return at most so many, the newest first.
    """
    columns = [column for column in events.c if column.name != "number"]
    order = events.c.number if newest is None else events.c.number.desc()
    query = sa.select(*columns).where(*conditions).order_by(order).limit(newest)
    found = connection.execute(query).mappings()
    return tuple(msgspec.convert(_plain(each), Event) for each in found)


def read_error_numbers(
    connection: sa.Connection, season: str, *conditions: sa.ColumnElement[bool]
) -> dict[str, int]:
    """Return the number of the valid errors of the submissions for which all conditions hold."""
    table = hidden_errors.c
    query = (
        sa.select(table.submission, sa.func.max(table.number).label("number"))
        .where(table.season == season, *conditions)
        .group_by(table.submission)
    )
    return {each.submission: each.number for each in connection.execute(query)}


@legible("an error of a hidden episode")
def read_errors(
    connection: sa.Connection, season: str, numbers: Mapping[str, int]
) -> dict[str, Errors]:
    """Return the errors with those numbers, by submission."""
    wanted = {number: submission for submission, number in numbers.items()}
    table = hidden_errors.c
    query = sa.select(table.number, table.rmse_mm).where(table.season == season)
    return {
        wanted[number]: np.frombuffer(content, ERRORS).astype(np.float64)
        for number, content in connection.execute(query)
        if number in wanted
    }


ERRORS = "<f8"
"""Stored form of the errors of hidden episodes."""


def record_entry(connection: sa.Connection, entry: BoardEntry, rmse_mm: Sequence[float]) -> None:
    """Add an entry, with the RMSE of its hidden episodes [mm] if it has a row."""
    content = {**vars(entry), "row": None if entry.row is None else entry.row.plain()}
    connection.execute(sa.insert(entries).values(**content))
    if entry.row is not None:
        record_errors(connection, entry.season, entry.submission, rmse_mm)


def record_errors(
    connection: sa.Connection, season: str, submission: str, rmse_mm: Sequence[float]
) -> None:
    """Add the RMSE of a submission's hidden episodes [mm]; the last added ones are valid."""
    content = np.asarray(rmse_mm, ERRORS).tobytes()
    connection.execute(
        sa.insert(hidden_errors).values(season=season, submission=submission, rmse_mm=content)
    )


def record_event(connection: sa.Connection, event: Event) -> None:
    """Add an event."""
    content: dict[str, Any] = dict(vars(event))
    connection.execute(sa.insert(events).values(**content))


ROWS: Final = 500
"""Number of rows that are copied at a time."""


def copy_tables(source: sa.Connection, target: sa.Connection) -> None:
    """Copy every row of every table.

    Parameters
    ----------
    source
        A connection that sees one state of its database.
    target
        A connection to a database whose tables are empty.
    """
    for table in metadata.sorted_tables:
        found = source.execute(sa.select(table).execution_options(yield_per=ROWS)).mappings()
        for some in found.partitions():
            target.execute(sa.insert(table), [dict(each) for each in some])
        if target.dialect.name == "postgresql" and "number" in table.c:
            # Rows that come with their number leave the sequence of numbers where it was.
            target.execute(
                sa.text(
                    f"SELECT setval(pg_get_serial_sequence('{table.name}', 'number'), "
                    f"(SELECT coalesce(max(number), 0) + 1 FROM {table.name}), false)"
                )
            )
