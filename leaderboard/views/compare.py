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
from colift.benchmark.rendering.axis import make_axis
from colift.benchmark.results.parts import parts_of
from colift.benchmark.results.strata import human_human_mean, vs_human_mean
from colift.benchmark.statistics import Estimate, PairedDifference, permutation_ps_against
from colift.leaderboard.core.standings import RankedRow
from colift.leaderboard.replays.chosen import made_replays
from colift.leaderboard.views.asked import CHOSEN, ROWS
from colift.leaderboard.views.lifts import (
    part_estimate,
    public_lifts,
    public_scores,
    stratum_scores,
    version,
)
from colift.leaderboard.views.page import Content, Page, Visit, find_season

ALL: Final = 40
"""Number of policies, from the best, in a page that shows only some of them at a time."""


EVERY: Final = 5
"""Frames between two points of a curve."""


@dataclass(frozen=True, kw_only=True)
class Column:
    """A policy, with its RMSE [mm] on each part of the public lifts."""

    standing: RankedRow
    rmse_mm: tuple[Estimate, ...]
    ratios: tuple[float | None, ...]
    """``vs_human`` on each part."""


def compare_page(visit: Visit, season: str) -> Content:
    """Return the comparison of the chosen policies, in the order in which they were chosen.

    Those that are not in the ranking are left out, and those beyond :data:`.CHOSEN`; if none are
    chosen, the first two of the table are compared. A site compares the best :data:`ALL`, and shows
    only some of them at a time. A ``difference`` is the RMSE of ``a`` minus that of ``b`` [mm], or
    None if the single lifts of one are missing. ``choice`` are the policies that can be chosen
    here, by ``names``; ``human_human_mm`` is the human-human baseline's mean RMSE on each part
    [mm].
    """
    board, digests = visit.board, visit.chosen
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
    parts = parts_of(strata)
    columns = tuple(
        Column(
            standing=ranked[digest],
            rmse_mm=tuple(part_estimate(path, part) for part in parts),
            ratios=tuple(vs_human_mean(part.of(stratum_scores(path))) for part in parts),
        )
        for digest, path in runs.items()
    )
    human_human = tuple(human_human_mean(part.of(strata)) for part in parts)
    pairs = _differences(tuple((path, version(path)) for path in runs.values()))
    names = _distinct_names(ranking, choice)
    return {
        "season": info,
        "asked": digests,
        "choice": choice,
        "total": len(ranking),
        "names": names,
        "parts": parts,
        "columns": columns,
        "human_human_mm": human_human,
        "pairs": tuple(
            {"a": ranked[a], "b": ranked[b], "difference": each}
            for (a, b), each in zip(itertools.combinations(runs, 2), pairs, strict=True)
        ),
        "axis": make_axis(
            [each for column in columns for each in column.rmse_mm],
            [each for each in human_human if each is not None],
        ),
        "data": _drawn(list(runs.values()), columns, names),
    }


def _drawn(
    bundles: Sequence[Path], columns: Sequence[Column], names: Mapping[str, str]
) -> dict[str, Any]:
    """Return the data that the page's script draws: each policy's lifts, and errors over time.

    The lifts are those of the first column, since all have the same; ``rmse`` is empty where the
    single lifts of a policy are missing. ``curves`` has, by its name, each lift that another policy
    also has: the shown error, every :data:`EVERY` frames [0.1 mm].
    """
    lifts = [public_lifts(path) for path in bundles]
    curves = _shared([_errors(path) for path in bundles])
    return {
        "lifts": [
            [lift.behaviour, lift.subject, lift.seed] for lift in next(filter(None, lifts), ())
        ],
        "policies": [
            {
                "p": column.standing.row.submission,
                "name": names[column.standing.row.submission],
                "rmse": [round(lift.rmse_mm, 3) for lift in own],
                "curves": dict(drawn),
            }
            for column, own, drawn in zip(columns, lifts, curves, strict=True)
        ],
        "step": EVERY * FRAME,
    }


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


@functools.lru_cache(maxsize=64)
def _differences(
    bundles: tuple[tuple[Path, tuple[int, int]], ...],
) -> tuple[PairedDifference | None, ...]:
    """Return the difference between each two of some bundles, in the order of combinations."""
    runs = [public_scores(bundle) for bundle, _ in bundles]
    found: list[PairedDifference | None] = []
    for i, one in enumerate(runs):
        others = runs[i + 1 :]
        same = [other for other in others if one.strata and other.strata == one.strata]
        errors = [other.rmse_mm for other in same]
        ps = iter(permutation_ps_against(one.rmse_mm, errors, one.units) if same else ())
        for other in others:
            found.append(one.against(other).tested(next(ps)) if other in same else None)
    return tuple(found)


PAGES: Final = (
    Page(
        name="compare",
        url="/seasons/{season}/compare",
        file="compare-{season}.html",
        view=compare_page,
        template="compare.html",
        meaning="Two to four policies, lift by lift: `?p=DIGEST` for each.",
        menu="Compare",
        place=20,
    ),
)
