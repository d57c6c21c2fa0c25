"""The compare page: two to four policies on the same public lifts, pair by pair."""

import functools
import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from ...benchmark.comparison.standing import Estimate
from ...benchmark.statistics import (
    Interval,
    paired_difference,
    permutation_ps_against,
    share_better,
)
from ..board import Board
from ..season import SeasonInfo
from ..standing import Standing
from .axis import Axis, make_axis
from .board import find_season, ordered_seasons
from .lifts import CellScore, cell_scores, public_lifts
from .parts import Part, estimate, parts_of, team_rmse

MOST: Final = 4
"""Policies that are compared at a time."""

ALL: Final = 40
"""Policies, from the best, that a page can hold which shows some of them later."""


@dataclass(frozen=True, kw_only=True)
class Column:
    """A policy, with its RMSE [mm] on each part of the public lifts."""

    standing: Standing
    rmse_mm: tuple[Estimate, ...]


@dataclass(frozen=True, kw_only=True)
class Difference:
    """What is between two policies, lift by lift."""

    mean_mm: float
    """Mean of the first one's RMSE minus the second one's [mm]."""
    ci95: Interval
    p: float
    """Of "they do not differ", by sign flips."""
    share_better: float
    """Share of the lifts in which the first is better."""


@dataclass(frozen=True, kw_only=True)
class Pair:
    """Two policies."""

    a: Standing
    b: Standing
    difference: Difference | None
    """Nothing if the single lifts of one of them are not there."""


@dataclass(frozen=True, kw_only=True)
class CompareView:
    """What the compare page shows."""

    season: SeasonInfo
    choice: tuple[Standing, ...]
    """All that can be chosen: the ranking."""
    parts: tuple[Part, ...]
    columns: tuple[Column, ...]
    team_mm: tuple[float | None, ...]
    """The human-human team's mean RMSE on each part [mm]."""
    pairs: tuple[Pair, ...]
    axis: Axis


def compare_view(
    board: Board, season: str | None = None, digests: Sequence[str] | None = None
) -> CompareView | None:
    """Return the comparison of some policies; None if there is no such season.

    Parameters
    ----------
    board, season
        Which table.
    digests
        The submissions; what is not in the ranking is left out, and what is beyond
        :data:`MOST`. None compares the best :data:`ALL`: for a page that shows some of them later.
    """
    info = find_season(ordered_seasons(board), season)
    if info is None:
        return None
    ranked = {each.row.submission: each for each in board.standings(info.name) if each.ranked}
    if digests is None:
        chosen = list(ranked)[:ALL]
    else:
        chosen = [digest for digest in dict.fromkeys(digests) if digest in ranked][:MOST]
    bundles = {digest: board.bundle(info.name, digest) for digest in chosen}
    runs = {digest: path for digest, path in bundles.items() if path is not None}
    cells = next((cell_scores(path) for path in runs.values()), ())
    parts = _parts(cells)
    columns = tuple(
        Column(standing=ranked[digest], rmse_mm=tuple(estimate(path, part) for part in parts))
        for digest, path in runs.items()
    )
    team = tuple(team_rmse(cells, part) for part in parts)
    pairs = _differences(tuple(runs.values()))
    names = itertools.combinations(runs, 2)
    return CompareView(
        season=info,
        choice=tuple(ranked.values()),
        parts=parts,
        columns=columns,
        team_mm=team,
        pairs=tuple(
            Pair(a=ranked[a], b=ranked[b], difference=each)
            for (a, b), each in zip(names, pairs, strict=True)
        ),
        axis=make_axis(
            [each for column in columns for each in column.rmse_mm],
            [each for each in team if each is not None],
        ),
    )


def _parts(cells: Sequence[CellScore]) -> tuple[Part, ...]:
    """Return all lifts, each behaviour and each subject; cells are for the policies' own pages."""
    found = parts_of(cells)
    return tuple(part for part in found if part.behaviour is None or part.subject is None)


@functools.lru_cache(maxsize=64)
def _differences(bundles: tuple[Path, ...]) -> tuple[Difference | None, ...]:
    """Return what is between each two of some bundles, in the order of their combinations."""
    runs = [public_lifts(bundle) for bundle in bundles]
    found: list[Difference | None] = []
    for i, a in enumerate(runs):
        errors = [lift.rmse_mm for lift in a]
        cells = [(lift.behaviour, lift.subject) for lift in a]
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
            found.append(_difference(errors, b, cells, next(ps)) if ok else None)
    return tuple(found)


def _difference(
    a: Sequence[float], b: Sequence[float], cells: Sequence[tuple[str, str]], p: float
) -> Difference:
    paired = paired_difference(a, b, cells)
    return Difference(mean_mm=paired.mean, ci95=paired.ci95, p=p, share_better=share_better(a, b))
