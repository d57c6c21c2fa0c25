"""The method page: the facts behind every number of a board; and the open questions."""

from typing import Final

from colift.agents.sandbox.host.levels import LEVELS, VERIFIABLE
from colift.agents.sandbox.protocol import LIMITS
from colift.benchmark.episode.metrics import FAILED_FRAME_MM
from colift.leaderboard.core.board import Board
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.views.page import Content, Page, Visit, find_season, ordered_seasons
from colift.leaderboard.views.references import references_of


def _method(visit: Visit) -> Content:
    """Return the numbers of the current season, and the isolation levels, strongest first."""
    season = find_season(visit.board)
    return {
        "season": season,
        "seasons": ordered_seasons(visit.board),
        "lifts": public_episodes(visit.board, season),
        "human_human": visit.board.human_human(season.name),
        "references": references_of(visit.board, season),
        "failed_frame_mm": FAILED_FRAME_MM,
        "limits": LIMITS,
        "isolation": LEVELS,
        "verifiable": VERIFIABLE,
    }


def public_episodes(board: Board, season: SeasonInfo) -> int | None:
    """Return the number of public lifts of an evaluation; None until there is a row."""
    newest = board.tables.newest(season.name, 1)
    return newest[0].row.public.episodes if newest else None


PAGES: Final = (
    Page(
        name="method",
        url="/method",
        file="method.html",
        view=_method,
        template="method.html",
        meaning="The facts behind every number.",
        menu="Method",
        place=40,
    ),
    Page(
        name="open",
        url="/open",
        file="open.html",
        view=lambda visit: {},
        template="open.html",
        meaning="The open questions.",
    ),
)
