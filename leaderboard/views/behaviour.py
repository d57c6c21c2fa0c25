"""The pages of the behaviours: what people do, and the policies' scores."""

import contextlib
import functools
from collections.abc import Sequence
from typing import Final

from colift.agents.humans import Subject
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.rendering.axis import make_axis
from colift.benchmark.results.parts import Part
from colift.benchmark.results.strata import (
    StratumScore,
    human_human_mean,
    mean_of_strata,
    spread_over_people,
    vs_human_mean,
)
from colift.benchmark.statistics import Estimate
from colift.benchmark.suites.suite import Suite
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.standings import RankedRow
from colift.leaderboard.records.metrics import board_metrics
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.views.asked import ROWS
from colift.leaderboard.views.lifts import known, part_estimate, stratum_scores
from colift.leaderboard.views.page import Content, NoPageError, Page, Visit, find_season
from colift.leaderboard.views.suites import season_suite

CURVES: Final = 5
"""Number of lifts whose intended heights are drawn, each of another person."""

HEAT: Final = 60
"""Number of policies, from the best, on the map of all behaviours."""

BEST: Final = 20
"""Number of policies, from the best, with an interval; the others have only a mean."""

SHOWN: Final = ("amplitude", "duration", "visual_delay", "haptic_delay", "stiffness", "pull")
"""Numbers of people whose ranges are shown."""


def behaviours(visit: Visit, season: str) -> Content:
    """Return the behaviours of a season, and the policies on all of them.

    The means are in millimetres; ``spread`` and ``rmse_mm`` of a row are by behaviour.
    """
    info, suite = _played(visit.board, season)
    scored = _scored(visit.board, info)
    parts = {name: Part(behaviour=name) for name in _names(suite)}
    some = next((strata for _, strata in scored), ())
    return {
        "season": info,
        "behaviours": list(parts),
        "people": len({each.subject.name for each in suite.scenarios}),
        "descriptions": {each.behaviour: _described(each) for each in suite.scenarios},
        "human_human_mm": {name: human_human_mean(part.of(some)) for name, part in parts.items()},
        "rows": [
            {
                "standing": each,
                "spread": {
                    name: spread_over_people(mine)
                    for name, part in parts.items()
                    if (mine := part.of(strata))
                },
                "rmse_mm": {
                    name: mean_of_strata(part.of(strata)).mean for name, part in parts.items()
                },
            }
            for each, strata in scored[:HEAT]
        ],
    }


def _names(suite: Suite) -> list[str]:
    return list(dict.fromkeys(scenario.behaviour for scenario in suite.scenarios))


def _played(board: Board, season: str) -> tuple[SeasonInfo, Suite]:
    """Return a season and its suite."""
    info = find_season(board, season)
    suite = season_suite(info)
    if suite is None:
        raise NoPageError(f"This colift does not play the suite of season {info.name}.")
    return info, suite


def _behaviour(visit: Visit, season: str, behaviour: str) -> Content:
    """Return a behaviour, curves of some people's lifts, and the policies that have played it."""
    board = visit.board
    info, suite = _played(board, season)
    scenarios = [each for each in suite.scenarios if each.behaviour == behaviour]
    if not scenarios:
        raise NoPageError(f"Season {season} has no such behaviour.")
    part = Part(behaviour=behaviour)
    scored = [(each, some) for each, strata in _scored(board, info) if (some := part.of(strata))]
    means = {each.row.submission: mean_of_strata(some).mean or 0.0 for each, some in scored}
    scored.sort(key=lambda each: means[each[0].row.submission])
    scored, total = scored[:ROWS], len(scored)
    estimates = [
        _estimate(board, each, means[each.row.submission], part, i < BEST)
        for i, (each, _) in enumerate(scored)
    ]
    human_human = human_human_mean(scored[0][1]) if scored else None
    metrics = board_metrics(info.suite)
    return {
        "season": info,
        "behaviour": behaviour,
        "description": _described(scenarios[0]),
        "people": len({each.subject.name for each in scenarios}),
        "ranges": _ranges([each.subject for each in scenarios]),
        "curves": [_curve(each, suite.seeds[0]) for each in scenarios[:CURVES]],
        "rows": [
            {
                "standing": each,
                "rmse_mm": estimate,
                "ratio": vs_human_mean(some),
                "spread": spread_over_people(some),
                "episodes": sum(one.episodes for one in some),
                "failed": sum(one.failed for one in some),
                "metrics": {metric.name: mean_of_strata(some, metric.name) for metric in metrics},
            }
            for (each, some), estimate in zip(scored, estimates, strict=True)
        ],
        "total": total,
        "human_human_mm": human_human,
        "axis": make_axis(estimates, () if human_human is None else (human_human,)),
    }


def _ranges(people: Sequence[Subject]) -> dict[str, tuple[float, float]]:
    """Return the least and the largest of some numbers of people."""
    values = {name: [getattr(each, name) for each in people] for name in SHOWN}
    return {name: (min(some), max(some)) for name, some in values.items()}


def _scored(board: Board, info: SeasonInfo) -> list[tuple[RankedRow, Sequence[StratumScore]]]:
    """Return the ranked rows that have a bundle, with their strata."""
    found: list[tuple[RankedRow, Sequence[StratumScore]]] = []
    for each in board.tables.read(info.name).ranking:
        bundle = board.bundle(info.name, each.row.submission)
        if bundle is not None:
            found.append((each, stratum_scores(bundle)))
    return found


def _estimate(
    board: Board, standing: RankedRow, mean: float, part: Part, interval: bool
) -> Estimate:
    bundle = board.bundle(standing.row.season, standing.row.submission)
    return part_estimate(bundle, part) if interval and bundle else known(mean)


def _described(scenario: Scenario) -> str:
    return (type(scenario.human).__doc__ or "").partition("\n")[0].strip()


@functools.lru_cache(maxsize=256)
def _curve(scenario: Scenario, seed: int) -> tuple[float, ...]:
    """Return the heights [mm] that a person intends in a lift, every 50 ms."""
    with contextlib.closing(Lift(scenario)) as lift:
        lift.reset(seed)
        return tuple(round(1000 * float(height), 1) for height in lift.target[::5])


PAGES: Final = (
    Page(
        name="behaviours",
        url="/seasons/{season}/behaviours",
        file="behaviours-{season}.html",
        view=behaviours,
        template="behaviours.html",
        meaning="The behaviours of a season, with every policy on each.",
        menu="Behaviours",
        place=30,
    ),
    Page(
        name="behaviour",
        url="/seasons/{season}/behaviours/{behaviour}",
        file="behaviour-{season}-{behaviour}.html",
        view=_behaviour,
        template="behaviour.html",
        meaning="A behaviour: the people, and the policies.",
    ),
)
