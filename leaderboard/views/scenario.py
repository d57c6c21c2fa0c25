"""The pages of the scenarios: behaviour, subject, and the policies' scores."""

import contextlib
import functools
from typing import Final

from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.results.scores import Stratum
from colift.benchmark.results.strata import StratumScore
from colift.benchmark.statistics import Estimate
from colift.benchmark.suites.suite import Suite
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.standings import RankedRow
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.views.asked import ROWS
from colift.leaderboard.views.axis import make_axis
from colift.leaderboard.views.lifts import Part, known, part_estimate, stratum_scores
from colift.leaderboard.views.page import Content, NoPageError, Page, Visit, find_season
from colift.leaderboard.views.suites import season_suite

CURVES: Final = 5
"""Number of lifts whose intended heights are drawn."""

HEAT: Final = 60
"""Number of policies, from the best, on the map of all scenarios."""

BEST: Final = 20
"""Number of policies, from the best, with an interval; the others have only a mean."""


def scenarios(visit: Visit, season: str) -> Content:
    """Return the scenarios of a season, behaviour by behaviour, and the policies on all of them.

    The means are in millimetres; ``rmse_mm`` of a row is by behaviour and subject.
    """
    info, suite = _played(visit.board, season)
    scored = _scored(visit.board, info)
    strata = {}
    for scenario in suite.scenarios:
        key = (scenario.behaviour, scenario.subject.name)
        there = (scores[key] for _, scores in scored if key in scores)
        human_human = next((score.human_human_rmse_mm for score in there), None)
        strata[key] = {
            "behaviour": key[0],
            "subject": key[1],
            "human_human_mm": human_human,
        }
    behaviours = list(dict.fromkeys(behaviour for behaviour, _ in strata))
    ordered = sorted(strata, key=lambda key: behaviours.index(key[0]))
    return {
        "season": info,
        "behaviours": behaviours,
        "descriptions": {each.behaviour: _described(each) for each in suite.scenarios},
        "columns": [strata[key] for key in ordered],
        "rows": [
            {
                "standing": each,
                "rmse_mm": {key: score.rmse_mm for key, score in scores.items()},
            }
            for each, scores in scored[:HEAT]
        ],
    }


def _played(board: Board, season: str) -> tuple[SeasonInfo, Suite]:
    """Return a season and its suite."""
    info = find_season(board, season)
    suite = season_suite(info)
    if suite is None:
        raise NoPageError(f"This colift does not play the suite of season {info.name}.")
    return info, suite


def _scenario(visit: Visit, season: str, behaviour: str, subject: str) -> Content:
    """Return a scenario, the first curves of its lifts, and the policies that have played it."""
    board = visit.board
    info, suite = _played(board, season)
    key = (behaviour, subject)
    scenario = next((s for s in suite.scenarios if (s.behaviour, s.subject.name) == key), None)
    if scenario is None:
        raise NoPageError(f"Season {season} has no such scenario.")
    scored = [(each, strata[key]) for each, strata in _scored(board, info) if key in strata]
    scored.sort(key=lambda each: each[1].rmse_mm)
    part = Part(behaviour=behaviour, subject=subject)
    estimates = [
        _estimate(board, each, score, part, i < BEST)
        for i, (each, score) in enumerate(scored[:ROWS])
    ]
    human_human = scored[0][1].human_human_rmse_mm if scored else None
    return {
        "season": info,
        "behaviour": behaviour,
        "description": _described(scenario),
        "subject": scenario.subject,
        "curves": _curves(scenario, suite.seeds[:CURVES]),
        "rows": [
            {"standing": each, "score": score, "rmse_mm": estimate}
            for (each, score), estimate in zip(scored, estimates, strict=False)
        ],
        "total": len(scored),
        "human_human_mm": human_human,
        "axis": make_axis(estimates, () if human_human is None else (human_human,)),
    }


def _scored(board: Board, info: SeasonInfo) -> list[tuple[RankedRow, dict[Stratum, StratumScore]]]:
    """Return the ranked rows that have a bundle, with their strata."""
    found = []
    for each in board.tables.read(info.name).ranking:
        bundle = board.bundle(info.name, each.row.submission)
        if bundle is not None:
            strata = {(one.behaviour, one.subject): one for one in stratum_scores(bundle)}
            found.append((each, strata))
    return found


def _estimate(
    board: Board, standing: RankedRow, score: StratumScore, part: Part, interval: bool
) -> Estimate:
    bundle = board.bundle(standing.row.season, standing.row.submission)
    return part_estimate(bundle, part) if interval and bundle else known(score.rmse_mm)


def _described(scenario: Scenario) -> str:
    return (type(scenario.human).__doc__ or "").partition("\n")[0].strip()


@functools.lru_cache(maxsize=256)
def _curves(scenario: Scenario, seeds: tuple[int, ...]) -> tuple[tuple[float, ...], ...]:
    """Return the heights [mm] that a person intends in some lifts, every 50 ms."""
    with contextlib.closing(Lift(scenario)) as lift:
        curves = []
        for seed in seeds:
            lift.reset(seed)
            curves.append(tuple(round(1000 * float(height), 1) for height in lift.target[::5]))
    return tuple(curves)


PAGES: Final = (
    Page(
        name="scenarios",
        url="/seasons/{season}/scenarios",
        file="scenarios-{season}.html",
        view=scenarios,
        template="scenarios.html",
        meaning="The scenarios of a season, with every policy on each.",
        menu="Scenarios",
        place=30,
    ),
    Page(
        name="scenario",
        url="/seasons/{season}/scenarios/{behaviour}/{subject}",
        file="scenario-{season}-{behaviour}-{subject}.html",
        view=_scenario,
        template="scenario.html",
        meaning="A behaviour with a person.",
    ),
)
