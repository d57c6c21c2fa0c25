"""The board page: rows of a season's table, and its picture."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Final
from weakref import WeakKeyDictionary

from colift.benchmark.episode.metric import LEADING
from colift.benchmark.rendering.axis import Axis, make_axis
from colift.benchmark.results.parts import Part, parts_of
from colift.benchmark.results.strata import (
    StratumScore,
    human_human_mean,
    mean_of_strata,
    vs_human_mean,
)
from colift.benchmark.statistics import Estimate
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.standings import UnrankedScores
from colift.leaderboard.core.tables import Table
from colift.leaderboard.records.metrics import board_metrics
from colift.leaderboard.views.asked import ROWS, Asked
from colift.leaderboard.views.glance import glance
from colift.leaderboard.views.lifts import known
from colift.leaderboard.views.lines import RankedLine, lines_of, strata_of
from colift.leaderboard.views.page import (
    Content,
    NoPageError,
    Page,
    Visit,
    find_season,
    ordered_seasons,
)
from colift.leaderboard.views.picture import PICTURED, pictures
from colift.leaderboard.views.references import SeasonReference, references_of

Unranked = Mapping[str, Any]
"""A line below the policies: the human-human baseline, or a ``reference``.

``rmse_mm`` is an :class:`.Estimate` or None, ``ratio`` its ``vs_human``; ``means`` are those of the
other metrics, all None on a part of the lifts.
"""


def board_page(
    board: Board, season: str | None = None, asked: Asked | None = None, most: int = ROWS
) -> dict[str, Any]:
    """Return the page of a season, by default of the current one.

    The number of queries does not depend on the number of rows, nor does the size of the page.
    ``rows`` are the lines that were asked for, ``complete`` if they are the whole ranking in its
    order; ``chosen`` the rows that are ticked and not among them; ``total`` the number of policies
    in the ranking, and ``leader`` its first. ``current`` is false while the next ranks are being
    computed. ``slow`` rows are not real-time and ranked among themselves, ``out`` are unverified,
    withdrawn or removed. ``people`` is the human-human baseline on the lifts of the lines,
    ``human_human`` that on the hidden ones, ``human_human_mm`` that on the public lifts of each
    behaviour; ``events`` are those of the season and its rows, newest first. ``glance`` is for a
    lift that needs more than a board, see :func:`.glance`.

    Parameters
    ----------
    board, season
        The table.
    asked
        What to show of it; by default its first rows.
    most
        Maximum number of rows, and of events.

    Raises
    ------
    NoPageError
        If there is no such season.
    """
    info = find_season(board, season)
    table, asked = board.tables.read(info.name), asked or Asked()
    strata = next((found for each in table.ranking if (found := strata_of(board, each.row))), ())
    behaviours = tuple(dict.fromkeys(stratum.behaviour for stratum in strata))
    lines = lines_of(board, table, asked, behaviours, most)
    human_human, known_references = board.human_human(info.name), references_of(board, info)
    events = board.events(season=info.name, newest=ROWS)
    wide, narrow = pictures(table, human_human, known_references)
    references = [_reference(each, asked.part) for each in known_references]
    shown = {each.standing.row.submission for each in lines.rows}
    axis, total, part = _axis(table, human_human), len(table.ranking), asked.part
    return {
        "season": info,
        "seasons": ordered_seasons(board),
        "asked": asked,
        "lines": lines,
        "rows": lines.rows,
        "complete": asked.plain and len(lines.rows) == total,
        "leader": next(iter(lines_of(board, table, Asked(), (), 1).rows), None),
        "total": total,
        "current": table.current,
        "chosen": [
            table.by_digest[each]
            for each in asked.chosen
            if each in table.by_digest and each not in shown
        ],
        "slow": table.sections["not real-time"],
        "out": (*table.sections["unverified"], *table.sections["out"]),
        "people": _people(human_human, strata, part),
        "references": references,
        "best_known_mm": next(
            (
                mm.mean
                for each in references
                if each["reference"].trained and (mm := each["rmse_mm"])
            ),
            None,
        ),
        "human_human": human_human,
        "human_human_mm": {
            each: human_human_mean(Part(behaviour=each).of(strata)) for each in behaviours
        },
        "axis": axis,
        "events": events,
        "names": {
            each.submission: table.by_digest[each.submission].row.name
            for each in events
            if each.submission is not None and each.submission in table.by_digest
        },
        "behaviours": behaviours,
        "empty_part": part is not None and not part.of(strata),
        "wide": wide,
        "narrow": narrow,
        "most": most,
        "most_pictured": PICTURED,
        "pictured": sum(dot.point.kind == "policy" for dot in wide.dots) if wide else 0,
        "data": _drawn(info.suite, axis, lines.rows, strata, known_references),
        "glance": None,
    }


def _drawn(
    suite: str,
    axis: Axis,
    rows: Sequence[RankedLine],
    strata: Sequence[StratumScore],
    references: Sequence[SeasonReference],
) -> dict[str, Any]:
    """Return the data that the page's script shows: each row's public lifts, by behaviour.

    ``behaviours`` has their names and the human-human RMSE [mm]; ``rows`` has, for each row of the
    table in its order and each behaviour, the RMSE [mm] and ``vs_human``, then for each of
    ``metrics`` the mean and the lifts without a value; ``references`` has each reference's RMSE
    [mm] and ``vs_human``, None where they are not known.
    """
    metrics, parts = board_metrics(suite), parts_of(strata)[1:]
    return {
        "top": axis.top,
        "metrics": [
            {name: getattr(each, name) for name in ("name", "digits", "better", "missing")}
            for each in metrics
        ],
        "behaviours": [[part.behaviour, human_human_mean(part.of(strata))] for part in parts],
        "rows": [
            [
                _numbers(part.of(row.strata), [metric.name for metric in metrics])
                for part in (parts if row.strata else ())
            ]
            for row in rows
        ],
        "references": [
            [
                [_rounded(value) for value in each.numbers.get(behaviour, (None, None))]
                for behaviour in dict.fromkeys(stratum.behaviour for stratum in strata)
            ]
            for each in references
        ],
    }


_axes: WeakKeyDictionary[Table, Axis] = WeakKeyDictionary()


def _axis(table: Table, human_human: UnrankedScores | None) -> Axis:
    """Return the scale of all pages of a table."""
    if table not in _axes:
        hidden = [each.row.hidden.rmse_mm for each in table.ranking]
        marks = () if human_human is None else (human_human.rmse_mm.ends[1],)
        _axes[table] = make_axis(hidden, marks)
    return _axes[table]


def _people(
    human_human: UnrankedScores | None, strata: Sequence[StratumScore], part: Part | None
) -> Unranked | None:
    """Return the line of the human-human baseline."""
    if human_human is None:
        return None
    if part is None:
        rmse: Estimate | None = human_human.rmse_mm
        return {"reference": None, "rmse_mm": rmse, "ratio": 1.0, "means": human_human.means}
    mean = human_human_mean(part.of(strata))
    rmse, ratio = (None, None) if mean is None else (known(mean), 1.0)
    means = dict.fromkeys(human_human.means)
    return {"reference": None, "rmse_mm": rmse, "ratio": ratio, "means": means}


def _reference(reference: SeasonReference, part: Part | None) -> Unranked:
    if part is None:
        hidden = reference.hidden
        return {
            "reference": reference,
            "rmse_mm": hidden.rmse_mm,
            "ratio": hidden.ratio,
            "means": hidden.means,
        }
    mean, ratio = reference.numbers.get(part.behaviour or "", (None, None))
    rmse = None if mean is None else known(mean)
    means = dict.fromkeys(reference.means)
    return {"reference": reference, "rmse_mm": rmse, "ratio": ratio, "means": means}


def _numbers(
    strata: Sequence[StratumScore], metrics: Sequence[str]
) -> list[float | list[float | None] | None]:
    rmse, *found = (mean_of_strata(strata, name) for name in (LEADING, *metrics))
    means = ([_rounded(each.mean), each.missing] for each in found)
    return [_rounded(rmse.mean), _rounded(vs_human_mean(strata)), *means]


def _rounded(mean: float | None) -> float | None:
    return None if mean is None else round(mean, 4)


def _shown(visit: Visit, season: str | None = None) -> Content:
    content = board_page(visit.board, season, visit.asked)
    info = content["season"]
    return {
        **content,
        "page": "front" if info.current else "season",
        "glance": None if visit.asked.first else glance(visit, info.name),
    }


def _further(visit: Visit, season: str, number: str) -> Content:
    """Return a page of rows of a site; the first is that of the table."""
    return _shown(replace(visit, asked=Asked(first=(int(number) - 1) * ROWS)), season)


def _rest(visit: Visit, season: str) -> Content:
    """Return the rows behind the first page, for a script of a site."""
    total = len(visit.board.tables.read(season).ranking)
    if total <= ROWS:
        raise NoPageError(f"Season {season} has a single page of rows.")
    return board_page(visit.board, season, Asked(first=ROWS), most=total)


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
