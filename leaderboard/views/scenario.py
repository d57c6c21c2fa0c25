"""The pages of the scenarios: behaviour, subject, and the policies' scores."""

import contextlib
import functools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from colift.agents.humans import Subject
from colift.benchmark.episode.lift import make_lift
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.statistics import Estimate
from colift.benchmark.suites.suite import Suite
from colift.leaderboard.board.board import Board
from colift.leaderboard.board.standings import RankedRow
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.views.asked import ROWS
from colift.leaderboard.views.axis import Axis, make_axis
from colift.leaderboard.views.lifts import Part, StratumScore, known, part_estimate, stratum_scores
from colift.leaderboard.views.page import NoPageError, Page, find_season
from colift.leaderboard.views.suites import season_suite

CURVES: Final = 5
"""Number of lifts whose intended heights are drawn."""

HEAT: Final = 60
"""Number of policies, from the best, on the map of all scenarios."""

BEST: Final = 20
"""Number of policies, from the best, with an interval; the others have only a mean."""


@dataclass(frozen=True, kw_only=True)
class Curve:
    """The heights that a person intends in one lift."""

    seed: int
    heights: tuple[float, ...]
    """Intended height [mm], every 50 ms."""


@dataclass(frozen=True, kw_only=True)
class ScenarioRow:
    """A policy on the lifts of a scenario."""

    standing: RankedRow
    score: StratumScore
    rmse_mm: Estimate


@dataclass(frozen=True, kw_only=True)
class ScenarioView:
    """The content of the page of a scenario."""

    season: SeasonInfo
    behaviour: str
    description: str
    """Description of the behaviour, in a line."""
    subject: Subject
    curves: tuple[Curve, ...]
    rows: tuple[ScenarioRow, ...]
    """Best first; at most :data:`.ROWS`."""
    total: int
    """Number of policies that have played it."""
    human_human_mm: float | None
    axis: Axis


@dataclass(frozen=True, kw_only=True)
class StratumLine:
    """A scenario among the others."""

    behaviour: str
    subject: str
    human_human_mm: float | None
    best_mm: float | None
    """Mean RMSE [mm] of the policy that is best on it."""
    best: RankedRow | None


@dataclass(frozen=True, kw_only=True)
class HeatRow:
    """A policy on all scenarios."""

    standing: RankedRow
    rmse_mm: dict[tuple[str, str], float]
    """Mean RMSE [mm] by behaviour and subject."""


@dataclass(frozen=True, kw_only=True)
class ScenariosView:
    """The content of the list of scenarios."""

    season: SeasonInfo
    behaviours: tuple[str, ...]
    subjects: tuple[str, ...]
    descriptions: dict[str, str]
    """Description of each behaviour, in a line."""
    strata: dict[tuple[str, str], StratumLine]
    """The strata of the suite, by behaviour and subject."""
    rows: tuple[HeatRow, ...]
    """The policies of the ranking, best first."""

    @property
    def columns(self) -> tuple[StratumLine, ...]:
        """The scenarios, behaviour by behaviour."""
        return tuple(sorted(self.strata.values(), key=lambda c: self.behaviours.index(c.behaviour)))


def scenarios_view(board: Board, season: str | None = None) -> ScenariosView:
    """Return the list of a season's scenarios.

    Raises
    ------
    NoPageError
        If there is no such season, or this colift does not play its suite.
    """
    info, suite = _played(board, season)
    scored = _scored(board, info)
    strata = {}
    for scenario in suite.scenarios:
        key = (scenario.behaviour, scenario.subject.name)
        there = [(score, row) for row, scores in scored if (score := _score(scores, key))]
        best = min(there, key=lambda each: each[0].rmse_mm, default=None)
        strata[key] = StratumLine(
            behaviour=key[0],
            subject=key[1],
            human_human_mm=None if best is None else best[0].human_human_rmse_mm,
            best_mm=None if best is None else best[0].rmse_mm,
            best=None if best is None else best[1],
        )
    return ScenariosView(
        season=info,
        behaviours=tuple(dict.fromkeys(behaviour for behaviour, _ in strata)),
        subjects=tuple(dict.fromkeys(subject for _, subject in strata)),
        descriptions={each.behaviour: _described(each) for each in suite.scenarios},
        strata=strata,
        rows=tuple(
            HeatRow(
                standing=each,
                rmse_mm={(score.behaviour, score.subject): score.rmse_mm for score in scores},
            )
            for each, scores in scored[:HEAT]
        ),
    )


def _played(board: Board, season: str | None) -> tuple[SeasonInfo, Suite]:
    """Return a season and its suite."""
    info = find_season(board, season)
    suite = season_suite(info)
    if suite is None:
        raise NoPageError(f"This colift does not play the suite of season {info.name}.")
    return info, suite


def scenario_view(board: Board, season: str, behaviour: str, subject: str) -> ScenarioView:
    """Return the page of a scenario.

    Raises
    ------
    NoPageError
        If the season has none of that name, or as :func:`scenarios_view`.
    """
    info, suite = _played(board, season)
    scenario = next(
        (s for s in suite.scenarios if (s.behaviour, s.subject.name) == (behaviour, subject)), None
    )
    if scenario is None:
        raise NoPageError(f"Season {season} has no such scenario.")
    key = (behaviour, subject)
    scored = [
        (each, score) for each, strata in _scored(board, info) if (score := _score(strata, key))
    ]
    scored.sort(key=lambda each: each[1].rmse_mm)
    part = Part(behaviour=behaviour, subject=subject)
    rows = tuple(
        ScenarioRow(
            standing=each, score=score, rmse_mm=_estimate(board, each, score, part, i < BEST)
        )
        for i, (each, score) in enumerate(scored[:ROWS])
    )
    human_human = rows[0].score.human_human_rmse_mm if rows else None
    return ScenarioView(
        season=info,
        behaviour=behaviour,
        description=_described(scenario),
        subject=scenario.subject,
        curves=_curves(scenario, suite.seeds[:CURVES]),
        rows=rows,
        total=len(scored),
        human_human_mm=human_human,
        axis=make_axis(
            [row.rmse_mm for row in rows], () if human_human is None else (human_human,)
        ),
    )


def _scored(board: Board, info: SeasonInfo) -> list[tuple[RankedRow, tuple[StratumScore, ...]]]:
    """Return the ranked rows that have a bundle, with their strata."""
    found = []
    for each in board.tables.read(info.name).ranking:
        bundle = board.bundle(info.name, each.row.submission)
        if bundle is not None:
            found.append((each, stratum_scores(bundle)))
    return found


def _score(strata: Sequence[StratumScore], key: tuple[str, str]) -> StratumScore | None:
    return next(
        (stratum for stratum in strata if (stratum.behaviour, stratum.subject) == key), None
    )


def _estimate(
    board: Board, standing: RankedRow, score: StratumScore, part: Part, interval: bool
) -> Estimate:
    bundle = board.bundle(standing.row.season, standing.row.submission)
    return part_estimate(bundle, part) if interval and bundle else known(score.rmse_mm)


def _described(scenario: Scenario) -> str:
    return (type(scenario.human).__doc__ or "").partition("\n")[0].strip()


@functools.lru_cache(maxsize=256)
def _curves(scenario: Scenario, seeds: tuple[int, ...]) -> tuple[Curve, ...]:
    curves = []
    with contextlib.closing(make_lift(scenario)) as lift:
        for seed in seeds:
            lift.reset(seed)
            heights = tuple(round(1000 * float(height), 1) for height in lift.target[::5])
            curves.append(Curve(seed=seed, heights=heights))
    return tuple(curves)


PAGES: Final = (
    Page(
        name="scenarios",
        url="/seasons/{season}/scenarios",
        file="scenarios-{season}.html",
        view=lambda visit, season: {"view": scenarios_view(visit.board, season)},
        template="scenarios.html",
        meaning="The scenarios of a season, with every policy on each.",
        menu="Scenarios",
        place=30,
    ),
    Page(
        name="scenario",
        url="/seasons/{season}/scenarios/{behaviour}/{subject}",
        file="scenario-{season}-{behaviour}-{subject}.html",
        view=lambda visit, season, behaviour, subject: {
            "view": scenario_view(visit.board, season, behaviour, subject)
        },
        template="scenario.html",
        meaning="A behaviour with a person.",
    ),
)
