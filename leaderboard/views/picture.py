"""The scatter picture of a board: error on hidden lifts, and on public ones a second metric."""

import threading
from collections.abc import Sequence
from typing import Final
from weakref import WeakKeyDictionary

from colift.benchmark.comparison.front import FrontPoint, exact, pareto_front
from colift.benchmark.comparison.scatter.scene import NARROW, WIDE, ScatterScene, make_scene
from colift.benchmark.episode.metric import Metric
from colift.leaderboard.core.standings import UnrankedScores
from colift.leaderboard.core.tables import Table
from colift.leaderboard.records.metrics import picture_axes
from colift.leaderboard.records.row import BoardRow
from colift.leaderboard.views.references import SeasonReference

PICTURED: Final = 100
"""Number of policies, from the best, in a picture, beside those on the front."""

Pictures = tuple[ScatterScene | None, ScatterScene | None]
"""A picture for a screen, and one for a telephone; None if there is no policy."""

_drawing: Final = threading.Lock()
"""Held while pictures are drawn, so that the readers of a new table do not all draw them."""

_made: WeakKeyDictionary[Table, tuple[list[UnrankedScores], Pictures]] = WeakKeyDictionary()
"""The pictures of a table, with the scores of the references in them."""


def pictures(
    table: Table, human_human: UnrankedScores | None, references: Sequence[SeasonReference]
) -> Pictures:
    """Return the pictures of a table; they are drawn once, and when references are played."""
    beside = [each.hidden for each in references]
    with _drawing:
        if table not in _made or _made[table][0] != beside:
            rows = _pictured([each.row for each in table.ranking])
            wide, narrow = (
                make_picture(rows, human_human, references, size=size) for size in (WIDE, NARROW)
            )
            _made[table] = beside, (wide, narrow)
        return _made[table][1]


def _pictured(rows: Sequence[BoardRow]) -> list[BoardRow]:
    """Return the rows of a picture: the best, and those that no other beats in both axes."""
    if len(rows) <= PICTURED:
        return list(rows)
    _, second = picture_axes(rows[0].suite)
    points = [_point(row, second) for row in rows]
    front = set(map(id, pareto_front(points, second)))
    drawn = zip(rows, points, strict=True)
    return [row for i, (row, point) in enumerate(drawn) if i < PICTURED or id(point) in front]


def _point(row: BoardRow, second: Metric) -> FrontPoint:
    return FrontPoint(
        name=row.name,
        rmse_mm=row.hidden.rmse_mm,
        second=exact(row.public.metrics[second.name].mean),
        missing=row.public.metrics[second.name].missing,
    )


def make_picture(
    rows: Sequence[BoardRow],
    human_human: UnrankedScores | None,
    references: Sequence[SeasonReference] = (),
    *,
    size: tuple[int, int],
) -> ScatterScene | None:
    """Return the picture; None if there is no policy.

    Parameters
    ----------
    rows
        The policies, best first: RMSE on the hidden lifts, as in the table, and the second
        metric on the public ones.
    human_human
        Two people on the hidden lifts.
    references
        Those of the season, on the hidden lifts.
    size
        Width and height [px].
    """
    if not rows:
        return None
    leading, second = axes = picture_axes(rows[0].suite)
    policies = [_point(row, second) for row in rows]
    others = [
        FrontPoint(
            name=name, rmse_mm=each.rmse_mm, second=exact(each.means[second.name]), kind=kind
        )
        for name, each, kind in (
            *(() if human_human is None else [("two people", human_human, "baseline")]),
            *((reference.name, reference, "reference") for reference in references),
        )
    ]
    axis = f"← {leading.words.praise[1]} · {leading.symbol} on the hidden lifts, {leading.unit}"
    return make_scene([*policies, *others], axes, axis=axis, size=size)
