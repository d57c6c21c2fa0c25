"""The rows of a season for other programs: CSV, JSON and an Atom feed."""

import json
import uuid
from dataclasses import dataclass
from datetime import datetime
from typing import Final

from colift.leaderboard.board.board import Board
from colift.leaderboard.board.standings import RankedRow, frame
from colift.leaderboard.client import API
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.views.page import Page, find_season

FORMULA: Final = ("=", "+", "-", "@", "\t", "\r")
"""First characters of a text that spreadsheets take for a formula."""


def standings_csv(board: Board, season: str | None = None) -> str:
    """Return the ranked rows as CSV, with the columns of :meth:`.Board.ranking`.

    A text that a spreadsheet would take for a formula has an apostrophe before it.

    Raises
    ------
    InputError
        If there is no such season, or pandas is not installed.
    """
    info = board.season_info(season)
    rows = frame(board.tables.read(info.name).rows, info.suite)
    return str(rows.map(_harmless).to_csv(index=False, lineterminator="\n"))


def standings_json(board: Board, season: str) -> str:
    """Return all rows as JSON: with rank group, time, submitter and events."""
    table = [
        {
            "section": each.section,
            "group": each.group,
            "at": each.at.isoformat(),
            "submitter": each.submitter,
            "row": each.row.plain(),
            "events": [event.plain() for event in each.events],
        }
        for each in board.tables.read(season).rows
    ]
    return json.dumps(table, indent=1) + "\n"


def _harmless(value: object) -> object:
    return f"'{value}" if isinstance(value, str) and value.startswith(FORMULA) else value


MOST: Final = 100
"""Maximum number of rows in a feed."""


@dataclass(frozen=True, kw_only=True)
class NewRow:
    """A row of the board."""

    id: uuid.UUID
    """Identifier; it is the same wherever the board is shown."""
    standing: RankedRow
    updated: datetime
    """Time of the last event, or of the entry."""


@dataclass(frozen=True, kw_only=True)
class News:
    """Content of a season's feed."""

    id: uuid.UUID
    season: SeasonInfo
    updated: datetime
    rows: tuple[NewRow, ...]


def news_of(board: Board, season: str) -> News:
    """Return the newest :data:`MOST` rows of a season.

    Raises
    ------
    NoPageError
        If there is no such season.
    """
    info = find_season(board, season)
    newest = board.tables.newest(season, MOST)
    rows = tuple(
        NewRow(
            id=_identifier(info, each.row.submission),
            standing=each,
            updated=max([each.at, *(event.at for event in each.events)]),
        )
        for each in newest
    )
    return News(
        id=_identifier(info, ""),
        season=info,
        updated=max([info.began_at, *(row.updated for row in rows)]),
        rows=rows,
    )


def _identifier(info: SeasonInfo, submission: str) -> uuid.UUID:
    """Return an identifier that follows from published facts of a season and a submission."""
    return uuid.uuid5(uuid.NAMESPACE_OID, f"{info.name} {info.commitment} {submission}")


PAGES: Final = (
    Page(
        name="feed",
        url="/seasons/{season}/feed.atom",
        file="data/{season}.atom",
        view=lambda visit, season: {
            "news": news_of(visit.board, season),
            "prefix": visit.origin,
        },
        template="feed.xml",
        media="application/atom+xml",
        meaning="The newest rows of a season, as an Atom feed.",
    ),
    Page(
        name="csv",
        url=API + "/standings.csv?season={season}",
        file="data/{season}.csv",
        view=lambda visit, season: standings_csv(visit.board, season),
    ),
    Page(
        name="json",
        url=API + "/standings?season={season}",
        file="data/{season}.json",
        view=lambda visit, season: standings_json(visit.board, season),
    ),
)
