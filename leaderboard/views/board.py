"""The board page: rows of a season's table, and its picture."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final
from weakref import WeakKeyDictionary

from colift.benchmark.comparison.scatter.scene import ScatterScene
from colift.benchmark.statistics import Estimate
from colift.leaderboard.board.board import Board
from colift.leaderboard.board.standings import HumanHumanScores, RankedRow
from colift.leaderboard.board.tables import Table
from colift.leaderboard.records.metrics import board_metrics
from colift.leaderboard.records.season import Event, SeasonInfo
from colift.leaderboard.views.asked import ROWS, Asked
from colift.leaderboard.views.axis import Axis, make_axis
from colift.leaderboard.views.bounds import PublicBound, bounds_of
from colift.leaderboard.views.lifts import Part, StratumScore, human_human_mean_rmse, known
from colift.leaderboard.views.lines import Lines, RankedLine, lines_of, strata_of
from colift.leaderboard.views.page import (
    Content,
    NoPageError,
    Page,
    Visit,
    find_season,
    ordered_seasons,
)
from colift.leaderboard.views.picture import PICTURED, pictures


@dataclass(frozen=True, kw_only=True)
class Reference:
    """A line below the policies: the human-human baseline, or a bound."""

    bound: PublicBound | None
    """None: the human-human baseline."""
    rmse_mm: Estimate | None
    ratio: float | None
    """RMSE over that of the human-human baseline."""
    means: Mapping[str, float | None]
    """Means of the other metrics of a board; none on a part of the lifts."""


@dataclass(frozen=True, kw_only=True)
class BoardView:
    """The content of the board page."""

    season: SeasonInfo
    seasons: tuple[SeasonInfo, ...]
    """All seasons, the current one first: the tabs."""
    asked: Asked
    lines: Lines
    leader: RankedLine | None
    """The first of the ranking."""
    total: int
    """Number of policies in the ranking."""
    current: bool
    """Whether the ranks are those of these rows; otherwise the next ones are being computed."""
    chosen: tuple[RankedRow, ...]
    """The rows that are ticked and not among the lines."""
    slow: tuple[RankedRow, ...]
    """Not real-time: ranked among themselves."""
    out: tuple[RankedRow, ...]
    """Unverified, withdrawn or removed."""
    people: Reference | None
    """The human-human baseline, on the lifts of the lines."""
    bounds: tuple[Reference, ...]
    """The bounds on the public lifts."""
    human_human: HumanHumanScores | None
    """The human-human baseline on the hidden lifts."""
    axis: Axis
    events: tuple[Event, ...]
    """The events of the season and its rows, newest first; at most :data:`.ROWS`."""
    names: Mapping[str, str]
    """Names of the submissions of the events."""
    strata: tuple[StratumScore, ...]
    """The strata of the suite, as a public run has them."""
    wide: ScatterScene | None
    narrow: ScatterScene | None
    pictured: int
    """Number of policies in the picture."""

    most: int = ROWS
    """Maximum number of rows of a page, and of each list."""
    most_pictured: int = PICTURED

    @property
    def rows(self) -> tuple[RankedLine, ...]:
        """The lines."""
        return self.lines.rows

    @property
    def complete(self) -> bool:
        """Whether they are the whole ranking, in its order."""
        return self.asked.plain and len(self.rows) == self.total

    @property
    def causal(self) -> float | None:
        """The RMSE [mm] of the causal bound on the public lifts, if that is known."""
        return next(
            (
                each.rmse_mm.mean
                for each in self.bounds
                if each.bound and each.bound.causal and each.rmse_mm
            ),
            None,
        )

    def human_human_mm(self, behaviour: str) -> float | None:
        """Return the human-human baseline's mean RMSE [mm] on the public lifts of a behaviour."""
        return human_human_mean_rmse(self.strata, Part(behaviour=behaviour, subject=None))

    @property
    def behaviours(self) -> tuple[str, ...]:
        """The behaviours of the suite, in its order."""
        return _behaviours(self.strata)

    @property
    def subjects(self) -> tuple[str, ...]:
        """The subjects of the suite, in its order."""
        return tuple(dict.fromkeys(stratum.subject for stratum in self.strata))

    @property
    def empty_part(self) -> bool:
        """Whether the suite has no lifts of the part that was asked for."""
        part = self.asked.part
        return part is not None and not any(part.has(stratum) for stratum in self.strata)

    @property
    def data(self) -> dict[str, Any]:
        """The data that the page's script filters: each row's public lifts, stratum by stratum.

        ``strata`` has behaviour, subject, episodes and the human-human RMSE [mm]; ``rows`` has, for
        each row of the table in its order and each stratum, the RMSE [mm], then for each of
        ``metrics`` the mean and the lifts without a value; ``bounds`` has each bound's RMSE [mm].
        """
        metrics = board_metrics(self.season.suite)
        return {
            "top": self.axis.top,
            "metrics": [
                {name: getattr(each, name) for name in ("name", "digits", "better", "missing")}
                for each in metrics
            ],
            "strata": [
                [c.behaviour, c.subject, c.episodes, c.human_human_rmse_mm] for c in self.strata
            ],
            "rows": [
                [_numbers(stratum, [metric.name for metric in metrics]) for stratum in row.strata]
                for row in self.rows
            ],
            "bounds": [
                [
                    round(each.bound.strata[stratum.behaviour, stratum.subject], 4)
                    for stratum in self.strata
                ]
                for each in self.bounds
                if each.bound is not None
            ],
        }


def board_view(
    board: Board, season: str | None = None, asked: Asked | None = None, most: int = ROWS
) -> BoardView:
    """Return the page of a season, by default of the current one.

    The number of queries does not depend on the number of rows, nor does the size of the page.

    Parameters
    ----------
    board, season
        The table.
    asked
        What to show of it; by default its first rows.
    most
        Maximum number of rows.

    Raises
    ------
    NoPageError
        If there is no such season.
    """
    info = find_season(board, season)
    table, asked = board.tables.read(info.name), asked or Asked()
    strata = next((found for each in table.ranking if (found := strata_of(board, each.row))), ())
    lines = lines_of(board, table, asked, _behaviours(strata), most)
    human_human, bounds = board.human_human(info.name), bounds_of(info)
    events = board.events(season=info.name, newest=ROWS)
    wide, narrow = pictures(table, human_human, bounds)
    leader = lines_of(board, table, Asked(), (), 1).rows
    shown = {each.standing.row.submission for each in lines.rows}
    slow = table.sections["not real-time"]
    out = (*table.sections["unverified"], *table.sections["out"])
    return BoardView(
        season=info,
        seasons=ordered_seasons(board),
        asked=asked,
        lines=lines,
        leader=leader[0] if leader else None,
        total=len(table.ranking),
        current=table.current,
        chosen=tuple(
            table.by_digest[each]
            for each in asked.chosen
            if each in table.by_digest and each not in shown
        ),
        slow=slow,
        out=out,
        people=_people(human_human, strata, asked.part),
        bounds=tuple(_bound(each, strata, asked.part) for each in bounds),
        human_human=human_human,
        axis=_axis(table, human_human),
        events=events,
        names={
            each.submission: table.by_digest[each.submission].row.name
            for each in events
            if each.submission is not None and each.submission in table.by_digest
        },
        strata=strata,
        wide=wide,
        narrow=narrow,
        most=most,
        pictured=sum(dot.point.kind == "policy" for dot in wide.dots) if wide else 0,
    )


_axes: WeakKeyDictionary[Table, Axis] = WeakKeyDictionary()


def _axis(table: Table, human_human: HumanHumanScores | None) -> Axis:
    """Return the scale of all pages of a table."""
    if table not in _axes:
        hidden = [each.row.hidden.rmse_mm for each in table.ranking]
        marks = () if human_human is None else (human_human.rmse_mm.ci95[1],)
        _axes[table] = make_axis(hidden, marks)
    return _axes[table]


def _behaviours(strata: Sequence[StratumScore]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(stratum.behaviour for stratum in strata))


def _people(
    human_human: HumanHumanScores | None, strata: Sequence[StratumScore], part: Part | None
) -> Reference | None:
    """Return the line of the human-human baseline."""
    if human_human is None:
        return None
    if part is None:
        rmse: Estimate | None = human_human.rmse_mm
        return Reference(bound=None, rmse_mm=rmse, ratio=1.0, means=human_human.means)
    mean = human_human_mean_rmse(strata, part)
    rmse, ratio = (None, None) if mean is None else (known(mean), 1.0)
    return Reference(bound=None, rmse_mm=rmse, ratio=ratio, means=dict.fromkeys(human_human.means))


def _bound(bound: PublicBound, strata: Sequence[StratumScore], part: Part | None) -> Reference:
    if part is None:
        return Reference(
            bound=bound, rmse_mm=bound.rmse_mm, ratio=bound.vs_human, means=bound.means
        )
    some = [stratum for stratum in strata if part.has(stratum)]
    lifts = sum(each.episodes for each in some)
    means = dict.fromkeys(bound.means)
    if not lifts:
        return Reference(bound=bound, rmse_mm=None, ratio=None, means=means)
    mean = sum(bound.strata[each.behaviour, each.subject] * each.episodes for each in some) / lifts
    people = human_human_mean_rmse(some)
    ratio = mean / people if people else None
    return Reference(bound=bound, rmse_mm=known(mean), ratio=ratio, means=means)


def _numbers(stratum: StratumScore, metrics: Sequence[str]) -> list[float | list[float | None]]:
    found = [stratum.metrics[name] for name in metrics]
    means = [[None if each.mean is None else round(each.mean, 4), each.missing] for each in found]
    return [round(stratum.rmse_mm, 4), *means]


def _shown(visit: Visit, season: str | None = None) -> Content:
    view = board_view(visit.board, season, visit.asked)
    return {"view": view, "page": "front" if view.season.current else "season"}


def _further(visit: Visit, season: str, number: str) -> Content:
    """Return a page of rows of a site; the first is that of the table."""
    return _shown(replace(visit, asked=Asked(first=(int(number) - 1) * ROWS)), season)


def _rest(visit: Visit, season: str) -> Content:
    """Return the rows behind the first page, for a script of a site."""
    total = len(visit.board.tables.read(season).ranking)
    if total <= ROWS:
        raise NoPageError(f"Season {season} has a single page of rows.")
    return {"view": board_view(visit.board, season, Asked(first=ROWS), most=total)}


PAGES: Final = (
    Page(
        name="front",
        url="/",
        file="index.html",
        view=_shown,
        template="board.html",
        meaning="The table of the current season.",
        menu="Board",
        place=10,
    ),
    Page(
        name="season",
        url="/seasons/{season}",
        file="season-{season}.html",
        view=_shown,
        template="board.html",
        meaning="The table of a season.",
    ),
    Page(name="rows", file="rows-{season}-{number}.html", view=_further, template="board.html"),
    Page(name="rest", file="data/{season}-rows.js", view=_rest, template="rest.js"),
)
