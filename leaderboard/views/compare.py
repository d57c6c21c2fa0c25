"""The compare page: two to four policies on the same public lifts, pair by pair."""

import functools
import itertools
import operator
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from colift.agents.agent import FRAME
from colift.benchmark.statistics import Estimate, PairedDifference, permutation_ps_against
from colift.leaderboard.board.board import Board
from colift.leaderboard.board.standings import RankedRow
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.replays.chosen import made_replays
from colift.leaderboard.views.asked import CHOSEN, ROWS
from colift.leaderboard.views.axis import Axis, make_axis
from colift.leaderboard.views.lifts import (
    Part,
    PublicLift,
    StratumScore,
    human_human_mean_rmse,
    part_estimate,
    parts_of,
    public_lifts,
    stratum_scores,
    version,
)
from colift.leaderboard.views.page import Page, find_season

ALL: Final = 40
"""Number of policies, from the best, in a page that shows only some of them at a time."""


EVERY: Final = 5
"""Frames between two points of a curve."""


@dataclass(frozen=True, kw_only=True)
class Column:
    """A policy, with its RMSE [mm] on each part of the public lifts."""

    standing: RankedRow
    rmse_mm: tuple[Estimate, ...]


@dataclass(frozen=True, kw_only=True)
class Pair:
    """Two policies."""

    a: RankedRow
    b: RankedRow
    difference: PairedDifference | None
    """RMSE of the first minus that of the second [mm]; None if the single lifts of one are
    missing."""


@dataclass(frozen=True, kw_only=True)
class CompareView:
    """The content of the compare page."""

    season: SeasonInfo
    choice: tuple[RankedRow, ...]
    """The policies that can be chosen here: the first of the ranking, and those that are shown."""
    total: int
    """Number of policies in the ranking."""
    names: Mapping[str, str]
    """What each of them is called here, by its digest; see :func:`_distinct_names`."""
    parts: tuple[Part, ...]
    columns: tuple[Column, ...]
    human_human_mm: tuple[float | None, ...]
    """The human-human baseline's mean RMSE on each part [mm]."""
    pairs: tuple[Pair, ...]
    axis: Axis
    lifts: tuple[PublicLift, ...]
    """The public lifts, of the first column; all have the same."""
    lift_rmse_mm: tuple[tuple[float, ...], ...]
    """RMSE [mm] of each column on each lift; empty where its single lifts are missing."""
    curves: tuple[Mapping[str, Sequence[int]], ...]
    """For each column, the lifts that another column also has, by their names: the shown error,
    every :data:`EVERY` frames [0.1 mm]."""

    @property
    def data(self) -> dict[str, Any]:
        """The data that the page's script draws: each policy's lifts, and errors over time."""
        return {
            "lifts": [[lift.behaviour, lift.subject, lift.seed] for lift in self.lifts],
            "policies": [
                {
                    "p": column.standing.row.submission,
                    "name": self.names[column.standing.row.submission],
                    "rmse": [round(each, 3) for each in rmse],
                    "curves": dict(curves),
                }
                for column, rmse, curves in zip(
                    self.columns, self.lift_rmse_mm, self.curves, strict=True
                )
            ],
            "step": EVERY * FRAME,
        }


def compare_view(
    board: Board, season: str | None = None, digests: Sequence[str] | None = None
) -> CompareView:
    """Return the comparison of some policies.

    Parameters
    ----------
    board, season
        The table.
    digests
        The submissions; those that are not in the ranking are left out, and those beyond
        :data:`.CHOSEN`. An empty sequence compares the first two of the table. None compares the
        best :data:`ALL`, for a page that shows only some of them at a time.

    Raises
    ------
    NoPageError
        If there is no such season.
    """
    info = find_season(board, season)
    ranking = board.tables.read(info.name).ranking
    ranked = {each.row.submission: each for each in ranking}
    if digests is None:
        chosen = list(ranked)[:ALL]
    elif not digests:
        chosen = list(ranked)[:2]
    else:
        chosen = [digest for digest in dict.fromkeys(digests) if digest in ranked][:CHOSEN]
    most = ALL if digests is None else ROWS
    choice = (
        *ranking[:most],
        *(ranked[each] for each in chosen if ranked[each] not in ranking[:most]),
    )
    bundles = {digest: board.bundle(info.name, digest) for digest in chosen}
    runs = {digest: path for digest, path in bundles.items() if path is not None}
    strata = next((stratum_scores(path) for path in runs.values()), ())
    parts = _parts(strata)
    columns = tuple(
        Column(standing=ranked[digest], rmse_mm=tuple(part_estimate(path, part) for part in parts))
        for digest, path in runs.items()
    )
    human_human = tuple(human_human_mean_rmse(strata, part) for part in parts)
    pairs = _differences(tuple((path, version(path)) for path in runs.values()))
    names = itertools.combinations(runs, 2)
    return CompareView(
        season=info,
        choice=choice,
        total=len(ranking),
        names=_distinct_names(ranking, choice),
        parts=parts,
        columns=columns,
        human_human_mm=human_human,
        pairs=tuple(
            Pair(a=ranked[a], b=ranked[b], difference=each)
            for (a, b), each in zip(names, pairs, strict=True)
        ),
        axis=make_axis(
            [each for column in columns for each in column.rmse_mm],
            [each for each in human_human if each is not None],
        ),
        lifts=next(filter(None, map(public_lifts, runs.values())), ()),
        lift_rmse_mm=tuple(
            tuple(lift.rmse_mm for lift in public_lifts(path)) for path in runs.values()
        ),
        curves=_shared([_errors(path) for path in runs.values()]),
    )


def _distinct_names(ranking: Sequence[RankedRow], shown: Sequence[RankedRow]) -> dict[str, str]:
    """Return the names of some rows by digest; one that repeats, with submitter and digest."""
    count = Counter(each.row.name for each in ranking)
    return {
        each.row.submission: each.row.name
        if count[each.row.name] == 1
        else f"{each.row.name} by {each.submitter}, {each.row.submission[:8]}"
        for each in shown
    }


def _shared(found: Sequence[Mapping[str, list[int]]]) -> tuple[Mapping[str, Sequence[int]], ...]:
    """Return the curves of the lifts of more than one policy."""
    count = Counter(name for curves in found for name in curves)
    return tuple(
        {name: curve for name, curve in curves.items() if count[name] > 1} for curves in found
    )


def _errors(bundle: Path) -> dict[str, list[int]]:
    """Return the errors over time of those replays of a bundle that have been made."""
    return {
        f"{each['behaviour']} {each['subject']} {each['seed']}": list(
            itertools.accumulate(map(operator.sub, *_compared(each)))
        )[::EVERY]
        for each in made_replays(bundle)
    }


def _compared(replay: Mapping[str, Any]) -> tuple[Sequence[int], Sequence[int]]:
    """Return the two series whose difference is the error; see :func:`.shown_error`."""
    drawn = replay.get("drawn", ())
    places = {each["goal"]: each["values"] for each in drawn if each["where"] == "place"}
    if len(places) == 2:
        return places[False], places[True]
    goals = [each["values"] for each in drawn if each["goal"]]
    return replay["robot"], goals[0] if goals else replay["human"]


def _parts(strata: Sequence[StratumScore]) -> tuple[Part, ...]:
    """Return all lifts, each behaviour and each subject; strata are for the policies' own pages."""
    found = parts_of(strata)
    return tuple(part for part in found if part.behaviour is None or part.subject is None)


@functools.lru_cache(maxsize=64)
def _differences(
    bundles: tuple[tuple[Path, tuple[int, int]], ...],
) -> tuple[PairedDifference | None, ...]:
    """Return the difference between each two of some bundles, in the order of combinations."""
    runs = [public_lifts(bundle) for bundle, _ in bundles]
    found: list[PairedDifference | None] = []
    for i, a in enumerate(runs):
        errors = [lift.rmse_mm for lift in a]
        strata = [(lift.behaviour, lift.subject) for lift in a]
        behind = [[lift.rmse_mm for lift in b] for b in runs[i + 1 :]]
        comparable = [bool(errors) and len(b) == len(errors) for b in behind]
        ps = iter(
            permutation_ps_against(
                errors, [b for b, ok in zip(behind, comparable, strict=True) if ok]
            )
            if any(comparable)
            else ()
        )
        for b, ok in zip(behind, comparable, strict=True):
            found.append(PairedDifference.of(errors, b, strata, next(ps)) if ok else None)
    return tuple(found)


PAGES: Final = (
    Page(
        name="compare",
        url="/seasons/{season}/compare",
        file="compare-{season}.html",
        view=lambda visit, season: {
            "view": compare_view(visit.board, season, visit.chosen),
            "asked": visit.chosen,
        },
        template="compare.html",
        meaning="Two to four policies, lift by lift: `?p=DIGEST` for each.",
        menu="Compare",
        place=20,
    ),
)
