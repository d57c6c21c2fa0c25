"""Reads the tables of a board: a fixed number of queries, however much is in them."""

from collections.abc import Mapping

import numpy as np
import sqlalchemy as sa

from ..entry import Entry
from ..event import Event
from ..row import Row
from ..season import SeasonInfo
from .recording import ERRORS
from .schema import entries, events, hidden_errors, seasons

Errors = np.ndarray[tuple[int], np.dtype[np.float64]]
"""RMSE of each hidden episode [mm]."""


def read_seasons(connection: sa.Connection) -> tuple[SeasonInfo, ...]:
    """Return all seasons in the order in which they came."""
    found = connection.execute(sa.select(seasons).order_by(seasons.c.number)).all()
    current = next((each.name for each in reversed(found) if each.taking), None)
    revealed = {
        event.season: (event.content or {})["secret"]
        for event in read_events(connection, events.c.kind == "revelation")
    }
    return tuple(
        SeasonInfo(
            name=each.name,
            suite=each.suite,
            suite_digest=each.suite_digest,
            commitment=each.commitment,
            began_at=each.began_at,
            current=each.name == current,
            revealed=revealed.get(each.name),
        )
        for each in found
    )


def read_entries(
    connection: sa.Connection, *conditions: sa.ColumnElement[bool]
) -> tuple[Entry, ...]:
    """Return the entries for which all conditions hold, in the order in which they came."""
    columns = [column for column in entries.c if column.name != "number"]
    query = sa.select(*columns).where(*conditions).order_by(entries.c.number)
    return tuple(
        Entry(**{**found, "row": None if found["row"] is None else Row.read(found["row"])})
        for found in connection.execute(query).mappings()
    )


def read_events(
    connection: sa.Connection, *conditions: sa.ColumnElement[bool]
) -> tuple[Event, ...]:
    """Return the events for which all conditions hold, oldest first."""
    columns = [column for column in events.c if column.name != "number"]
    query = sa.select(*columns).where(*conditions).order_by(events.c.number)
    return tuple(Event(**found) for found in connection.execute(query).mappings())


def read_error_numbers(connection: sa.Connection, season: str) -> dict[str, int]:
    """Return the number of the errors that count, by submission."""
    table = hidden_errors.c
    query = (
        sa.select(table.submission, sa.func.max(table.number).label("number"))
        .where(table.season == season)
        .group_by(table.submission)
    )
    return {each.submission: each.number for each in connection.execute(query)}


def read_errors(
    connection: sa.Connection, season: str, numbers: Mapping[str, int]
) -> dict[str, Errors]:
    """Return the errors of those numbers, by submission."""
    wanted = {number: submission for submission, number in numbers.items()}
    table = hidden_errors.c
    query = sa.select(table.number, table.rmse_mm).where(table.season == season)
    return {
        wanted[number]: np.frombuffer(content, ERRORS).astype(np.float64)
        for number, content in connection.execute(query)
        if number in wanted
    }
