"""The rows of a season for other programs: CSV, JSON and an Atom feed."""

import json
import uuid
from typing import Any, Final

from colift.leaderboard.client import API
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.standings import frame
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.views.page import Content, Page, Visit, find_season

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


def standings_plain(board: Board, season: str) -> list[dict[str, Any]]:
    """Return all rows as JSON: with rank, time, submitter and events."""
    return [
        {
            "section": each.section,
            "rank": each.rank,
            "at": each.at.isoformat(),
            "submitter": each.submitter,
            "row": each.row.plain(),
            "events": [event.plain() for event in each.events],
        }
        for each in board.tables.read(season).rows
    ]


def _harmless(value: object) -> object:
    return f"'{value}" if isinstance(value, str) and value.startswith(FORMULA) else value


MOST: Final = 100
"""Maximum number of rows in a feed."""


def _news(visit: Visit, season: str) -> Content:
    """Return the newest :data:`MOST` rows, each with its last change; identifiers never change."""
    info = find_season(visit.board, season)
    rows: list[dict[str, Any]] = [
        {
            "id": _identifier(info, each.row.submission),
            "standing": each,
            "updated": max([each.at, *(event.at for event in each.events)]),
        }
        for each in visit.board.tables.newest(season, MOST)
    ]
    return {
        "id": _identifier(info, ""),
        "season": info,
        "updated": max([info.began_at, *(row["updated"] for row in rows)]),
        "rows": rows,
        "prefix": visit.origin,
    }


def _identifier(info: SeasonInfo, submission: str) -> uuid.UUID:
    """Return an identifier that follows from published facts of a season and a submission."""
    return uuid.uuid5(uuid.NAMESPACE_OID, f"{info.name} {info.commitment} {submission}")


PAGES: Final = (
    Page(
        name="feed",
        url="/seasons/{season}/feed.atom",
        file="data/{season}.atom",
        view=_news,
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
        view=lambda visit, season: (
            json.dumps(standings_plain(visit.board, season), indent=1) + "\n"
        ),
    ),
)
