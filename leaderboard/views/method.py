"""The method page: the facts behind every number of a board."""

from dataclasses import dataclass
from typing import Final

from colift.agents.sandbox.host.levels import LEVELS, VERIFIABLE
from colift.agents.sandbox.protocol import LIMITS, Limits
from colift.benchmark.episode.metrics import FAILED_FRAME_MM
from colift.leaderboard.board.board import Board
from colift.leaderboard.board.standings import HumanHumanScores
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.views.bounds import bounds_of
from colift.leaderboard.views.page import Page, find_season, ordered_seasons


@dataclass(frozen=True, kw_only=True)
class MethodView:
    """The content of the method page."""

    season: SeasonInfo
    seasons: tuple[SeasonInfo, ...]
    lifts: int | None
    """Number of public lifts of an evaluation, and of hidden ones. None until there is a row."""
    human_human: HumanHumanScores | None
    causal: bool
    """Whether the causal bound is known on the public lifts."""
    oracle: bool
    """Whether the oracle is."""
    failed_frame_mm: float
    limits: Limits
    isolation: dict[str, str]
    """The isolation levels, strongest first."""
    verifiable: frozenset[str]
    """The levels at which a row can be verified."""


def method_view(board: Board) -> MethodView:
    """Return the method page, with the numbers of the current season."""
    info = find_season(board)
    bounds = bounds_of(info)
    return MethodView(
        season=info,
        seasons=ordered_seasons(board),
        lifts=public_episodes(board, info),
        human_human=board.human_human(info.name),
        causal=any(each.causal for each in bounds),
        oracle=any(not each.causal for each in bounds),
        failed_frame_mm=FAILED_FRAME_MM,
        limits=LIMITS,
        isolation=dict(LEVELS),
        verifiable=VERIFIABLE,
    )


def public_episodes(board: Board, season: SeasonInfo) -> int | None:
    """Return the number of public lifts of an evaluation; None until there is a row."""
    newest = board.tables.newest(season.name, 1)
    return newest[0].row.public.episodes if newest else None


PAGES: Final = (
    Page(
        name="method",
        url="/method",
        file="method.html",
        view=lambda visit: {"view": method_view(visit.board)},
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
