"""A season's table as data: what the pages show, for other programs."""

import json
from typing import Final

from ..board import Board

FORMULA: Final = ("=", "+", "-", "@", "\t", "\r")
"""Beginnings of a text that spreadsheets take for a formula."""


def standings_csv(board: Board, season: str | None = None) -> str:
    """Return the ranked rows as CSV, in the columns of :meth:`.Board.ranking`.

    A text that a spreadsheet would take for a formula has an apostrophe before it.

    Raises
    ------
    InputError
        If there is no such season, or pandas is not installed.
    """
    frame = board.ranking(season)
    return str(frame.map(_harmless).to_csv(index=False, lineterminator="\n"))


def standings_json(board: Board, season: str) -> str:
    """Return all rows as JSON: with rank group, time, submitter and events."""
    table = [
        {
            "group": each.group,
            "at": each.at.isoformat(),
            "submitter": each.submitter,
            "row": each.row.plain(),
            "events": [event.plain() for event in each.events],
        }
        for each in board.standings(season)
    ]
    return json.dumps(table, indent=1) + "\n"


def _harmless(value: object) -> object:
    return f"'{value}" if isinstance(value, str) and value.startswith(FORMULA) else value
