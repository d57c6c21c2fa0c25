"""Adds to the tables that only grow."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import sqlalchemy as sa

from ..entry import Entry
from ..event import Event
from .schema import entries, events, hidden_errors

ERRORS = "<f8"
"""How the errors of hidden episodes are kept."""


def record_entry(connection: sa.Connection, entry: Entry, rmse_mm: Sequence[float]) -> None:
    """Add an entry, with the RMSE of its hidden episodes [mm] if it has a row."""
    content = {**vars(entry), "row": None if entry.row is None else entry.row.plain()}
    connection.execute(sa.insert(entries).values(**content))
    if entry.row is not None:
        record_errors(connection, entry.season, entry.submission, rmse_mm)


def record_errors(
    connection: sa.Connection, season: str, submission: str, rmse_mm: Sequence[float]
) -> None:
    """Add the RMSE of a submission's hidden episodes [mm]; the last ones count."""
    content = np.asarray(rmse_mm, ERRORS).tobytes()
    connection.execute(
        sa.insert(hidden_errors).values(season=season, submission=submission, rmse_mm=content)
    )


def record_event(connection: sa.Connection, event: Event) -> None:
    """Add what has happened."""
    content: dict[str, Any] = dict(vars(event))
    connection.execute(sa.insert(events).values(**content))
