"""Lines of the board's table: their numbers, the search, and the order of the columns."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from colift.benchmark.results.parts import Part
from colift.benchmark.results.strata import StratumScore, mean_of_strata, vs_human_mean
from colift.benchmark.statistics import Estimate, MeanWithMissing
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.standings import RankedRow
from colift.leaderboard.core.tables import Table
from colift.leaderboard.records.metrics import board_metrics, sort_key
from colift.leaderboard.records.row import BoardRow
from colift.leaderboard.views.asked import ROWS, Asked
from colift.leaderboard.views.lifts import known, stratum_scores


@dataclass(frozen=True, kw_only=True)
class Scores:
    """The numbers of a line: on all hidden lifts, or on a part of the public ones."""

    rmse_mm: Estimate | None
    """None if the public run is missing, or has no such lifts."""
    ratio: float | None
    """``vs_human`` on these lifts."""
    metrics: Mapping[str, MeanWithMissing]
    """The other metrics of a board, always on public lifts."""


@dataclass(frozen=True, kw_only=True)
class RankedLine:
    """A line of the table."""

    standing: RankedRow
    index: int
    """Place in the ranking, from 0."""
    strata: tuple[StratumScore, ...]
    """Its public lifts, stratum by stratum; nothing if its bundle is gone."""
    scores: Scores
    shared: int
    """Number of policies of its rank."""
    leads: bool
    """Whether it is the first of its rank."""

    def mean_mm(self, behaviour: str) -> float | None:
        """Return the mean RMSE [mm] on the public lifts of a behaviour, if its bundle is there."""
        return mean_of_strata(Part(behaviour=behaviour).of(self.strata)).mean

    @property
    def text(self) -> str:
        """The text in which a search looks."""
        return search_text(self.standing.row)


@dataclass(frozen=True, kw_only=True)
class Lines:
    """The lines that were asked for."""

    rows: tuple[RankedLine, ...]
    first: int
    """Place of the first one among those that fit."""
    count: int
    """Number of lines that fit the search."""


def lines_of(
    board: Board, table: Table, asked: Asked, behaviours: Sequence[str], most: int = ROWS
) -> Lines:
    """Return the lines of a ranking that were asked for.

    Parameters
    ----------
    board
        The board, for the public runs.
    table
        The table.
    asked
        The question.
    behaviours
        The behaviours of the suite: their columns are ``b0``, ``b1`` ...
    most
        Maximum number of lines.
    """
    words = asked.search.lower().split()
    positions = [
        position
        for position, each in enumerate(table.ranking)
        if not words or all(word in search_text(each.row) for word in words)
    ]
    if asked.sort != "rank":
        positions = _sorted(board, table, positions, asked, behaviours)
    first = min(asked.first, max(0, len(positions) - 1))
    rows = tuple(
        _line(board, table, position, asked) for position in positions[first : first + most]
    )
    return Lines(rows=rows, first=first, count=len(positions))


def search_text(row: BoardRow) -> str:
    """Return the text of a row in which a search looks."""
    method = "learned" if row.learned else "designed"
    return f"{row.name} {' '.join(row.authors)} {row.licence} {method}".lower()


def strata_of(board: Board, row: BoardRow) -> tuple[StratumScore, ...]:
    """Return the public lifts of a row, stratum by stratum; nothing if its bundle is gone."""
    bundle = board.bundle(row.season, row.submission)
    return () if bundle is None else stratum_scores(bundle)


def _line(board: Board, table: Table, position: int, asked: Asked) -> RankedLine:
    each = table.ranking[position]
    strata = strata_of(board, each.row)
    before = table.ranking[position - 1] if position else None
    return RankedLine(
        standing=each,
        index=position,
        strata=strata,
        scores=_scores(each.row, strata, asked.part),
        shared=1 if each.pending else table.sizes[each.rank],
        leads=not each.pending and (before is None or before.rank != each.rank),
    )


def _scores(row: BoardRow, strata: Sequence[StratumScore], part: Part | None) -> Scores:
    if part is None:
        hidden = row.hidden
        return Scores(
            rmse_mm=hidden.rmse_mm, ratio=hidden.vs_human.mean, metrics=row.public.metrics
        )
    some = part.of(strata)
    rmse = mean_of_strata(some).mean
    return Scores(
        rmse_mm=None if rmse is None else known(rmse),
        ratio=vs_human_mean(some),
        metrics={each.name: mean_of_strata(some, each.name) for each in board_metrics(row.suite)},
    )


Key = float | str | None
"""What lines are sorted by; None, a missing value, is last either way."""

_OF_ROW: Final[Mapping[str, Callable[[RankedRow], Key]]] = {
    "name": lambda each: each.row.name.lower(),
    "step": lambda each: each.row.public.step_ms_p50,
    "gap": lambda each: each.row.gap.mean,
    "learned": lambda each: float(each.row.learned),
    "licence": lambda each: each.row.licence.lower(),
    "at": lambda each: -each.at.timestamp(),
}
"""The columns that need no public run."""


def _sorted(
    board: Board, table: Table, positions: Sequence[int], asked: Asked, behaviours: Sequence[str]
) -> list[int]:
    """Return places in the order that was asked for; in that of the ranks if it is unknown."""
    name = asked.column

    def key(position: int) -> Key:
        each = table.ranking[position]
        if name in _OF_ROW:
            return _OF_ROW[name](each)
        if name in columns:
            part = Part(behaviour=columns[name])
            return mean_of_strata(part.of(strata_of(board, each.row))).mean
        strata = () if asked.part is None else strata_of(board, each.row)
        scores = _scores(each.row, strata, asked.part)
        if name == "rmse":
            return None if scores.rmse_mm is None else scores.rmse_mm.mean
        if name == "ratio":
            return scores.ratio
        return next(
            (
                sort_key(metric, scores.metrics[name])
                for metric in board_metrics(each.row.suite)
                if metric.name == name
            ),
            float(position),
        )

    columns = {f"b{i}": behaviour for i, behaviour in enumerate(behaviours)}
    keys = {position: key(position) for position in positions}
    there = [position for position in positions if not _missing(keys[position])]
    # Two passes, so that equal ones stay in the order of the ranks either way.
    there.sort(key=lambda position: keys[position], reverse=asked.down)  # type: ignore[arg-type,return-value]
    return [*there, *(position for position in positions if _missing(keys[position]))]


def _missing(key: Key) -> bool:
    return key is None or (isinstance(key, float) and math.isnan(key))
