"""The board page: a season's table, and its picture."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...benchmark.comparison.scatter.scene import NARROW, WIDE, ScatterScene
from ...benchmark.episode.metric import Metric
from ..board.board import Board
from ..board.standings import HumanHumanScores, RankedRow
from ..records.metrics import board_metrics
from ..records.season import Event, SeasonInfo
from .axis import Axis, make_axis
from .bounds import PublicBound, bounds_of
from .lifts import Part, StratumScore, human_human_mean_rmse, mean_rmse, stratum_scores
from .picture import make_picture


@dataclass(frozen=True, kw_only=True)
class RankedLine:
    """A line of the table."""

    standing: RankedRow
    strata: tuple[StratumScore, ...]
    """Its public lifts, stratum by stratum; nothing if its bundle is gone."""
    shared: int
    """Number of policies in its rank group."""
    leads: bool
    """Whether it is the first of its group."""

    def mean_mm(self, behaviour: str) -> float | None:
        """Return the mean RMSE [mm] on the public lifts of a behaviour, if its bundle is there."""
        return mean_rmse(self.strata, Part(behaviour=behaviour, subject=None))


@dataclass(frozen=True, kw_only=True)
class BoardView:
    """The content of the board page."""

    season: SeasonInfo
    seasons: tuple[SeasonInfo, ...]
    """All seasons, the current one first: the tabs."""
    rows: tuple[RankedLine, ...]
    slow: tuple[RankedRow, ...]
    """Not real-time: ranked among themselves."""
    out: tuple[RankedRow, ...]
    """Unverified, withdrawn or removed."""
    human_human: HumanHumanScores | None
    """The human-human baseline on the hidden lifts."""
    bounds: tuple[PublicBound, ...]
    """The bounds on the public lifts."""
    axis: Axis
    events: tuple[Event, ...]
    """The events of the season and its rows, newest first."""
    names: dict[str, str]
    """Names of the submissions of the events."""
    wide: ScatterScene | None
    narrow: ScatterScene | None

    @property
    def causal(self) -> float | None:
        """The RMSE [mm] of the causal bound on the public lifts, if that is known."""
        return next((each.rmse_mm.mean for each in self.bounds if each.causal), None)

    def human_human_mm(self, behaviour: str) -> float | None:
        """Return the human-human baseline's mean RMSE [mm] on the public lifts of a behaviour."""
        return human_human_mean_rmse(self._strata, Part(behaviour=behaviour, subject=None))

    @property
    def behaviours(self) -> tuple[str, ...]:
        """The behaviours of the suite, in its order."""
        return tuple(dict.fromkeys(stratum.behaviour for stratum in self._strata))

    @property
    def _metrics(self) -> tuple[Metric, ...]:
        return board_metrics(self.season.suite)

    @property
    def subjects(self) -> tuple[str, ...]:
        """The subjects of the suite, in its order."""
        return tuple(dict.fromkeys(stratum.subject for stratum in self._strata))

    @property
    def data(self) -> dict[str, Any]:
        """The data that the page's script filters: each row's public lifts, stratum by stratum.

        ``strata`` has behaviour, subject, episodes and the human-human RMSE [mm]; ``rows`` has, for
        each row of the table in its order and each stratum, the RMSE [mm], then for each of
        ``metrics`` the mean and the lifts without a value; ``bounds`` has each bound's RMSE [mm].
        """
        return {
            "top": self.axis.top,
            "metrics": [
                {name: getattr(each, name) for name in ("name", "digits", "better", "missing")}
                for each in self._metrics
            ],
            "strata": [
                [c.behaviour, c.subject, c.episodes, c.human_human_rmse_mm] for c in self._strata
            ],
            "rows": [
                [_numbers(stratum, self._metrics) for stratum in row.strata] for row in self.rows
            ],
            "bounds": [
                [
                    round(bound.strata[stratum.behaviour, stratum.subject], 4)
                    for stratum in self._strata
                ]
                for bound in self.bounds
            ],
        }

    @property
    def _strata(self) -> tuple[StratumScore, ...]:
        return next((row.strata for row in self.rows if row.strata), ())


def board_view(board: Board, season: str | None = None) -> BoardView | None:
    """Return the page of a season, by default of the current one; None if there is no such season.

    The number of queries does not depend on the number of rows.
    """
    seasons = ordered_seasons(board)
    info = find_season(seasons, season)
    if info is None:
        return None
    standings = board.standings(info.name)
    ranked = [each for each in standings if each.ranked]
    sizes: dict[int, int] = {}
    for each in ranked:
        sizes[each.group] = sizes.get(each.group, 0) + 1
    rows = tuple(
        RankedLine(
            standing=each,
            strata=_strata_of(board.bundle(info.name, each.row.submission)),
            shared=sizes[each.group],
            leads=i == 0 or ranked[i - 1].group != each.group,
        )
        for i, each in enumerate(ranked)
    )
    human_human = board.human_human(info.name)
    hidden = [each.row.hidden.rmse_mm for each in ranked]
    bounds = bounds_of(info)
    pictured = [each.row for each in ranked]
    return BoardView(
        season=info,
        seasons=seasons,
        rows=rows,
        slow=tuple(each for each in standings if each.section == "not real-time"),
        out=tuple(each for each in standings if each.section in ("unverified", "out")),
        human_human=human_human,
        bounds=bounds,
        axis=make_axis(hidden, () if human_human is None else (human_human.rmse_mm.ci95[1],)),
        events=tuple(reversed(board.events(season=info.name))),
        names={each.row.submission: each.row.name for each in standings},
        wide=make_picture(pictured, human_human, bounds, size=WIDE),
        narrow=make_picture(pictured, human_human, bounds, size=NARROW),
    )


def ordered_seasons(board: Board) -> tuple[SeasonInfo, ...]:
    """Return the seasons, the current one first, then the newest."""
    by_age = sorted(board.seasons(), key=lambda info: info.began_at, reverse=True)
    return tuple(sorted(by_age, key=lambda info: not info.current))


def find_season(seasons: Sequence[SeasonInfo], name: str | None) -> SeasonInfo | None:
    """Return the season of that name, or the first if no name is given."""
    return next((info for info in seasons if name in (None, info.name)), None)


def _strata_of(bundle: Path | None) -> tuple[StratumScore, ...]:
    return () if bundle is None else stratum_scores(bundle)


def _numbers(
    stratum: StratumScore, metrics: tuple[Metric, ...]
) -> list[float | list[float | None]]:
    found = [stratum.metrics[metric.name] for metric in metrics]
    means = [[None if each.mean is None else round(each.mean, 4), each.missing] for each in found]
    return [round(stratum.rmse_mm, 4), *means]
