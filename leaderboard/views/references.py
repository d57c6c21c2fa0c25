"""The references beside a table, on the lifts of its rows."""

import functools
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from colift.benchmark.references.oracle import ORACLE
from colift.benchmark.references.told import TOLD
from colift.benchmark.results.baselines import (
    BEST_KNOWN,
    HUMAN_HUMAN,
    reference_label,
    shipped_baselines,
    shipped_references,
)
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.statistics import Estimate
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.standings import UnrankedScores
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.views.suites import season_suite

MEANINGS: Final[Mapping[str, str]] = {
    BEST_KNOWN: "sees what a policy sees; trained longer, for a small error alone: the least "
    "error known so far",
    TOLD: "is told what each lift draws and a policy has to infer",
    ORACLE: "knows where the person is going, and rehearses the lift",
}
"""Description of each reference."""


@dataclass(frozen=True, kw_only=True)
class SeasonReference:
    """A reference on the lifts of a season; it is not a policy and has no rank."""

    key: str
    """Its name in files."""
    hidden: UnrankedScores
    """Its scores on the hidden lifts."""
    public: tuple[ScoreTable, ScoreTable] | None
    """Its errors and those of two people on the public lifts, for parts of them."""

    @property
    def name(self) -> str:
        """Its name on pages."""
        return reference_label(self.key)

    @property
    def meaning(self) -> str:
        """What it knows."""
        return MEANINGS.get(self.key, "no policy, and not ranked")

    @property
    def rmse_mm(self) -> Estimate:
        """Mean RMSE on the hidden lifts [mm]."""
        return self.hidden.rmse_mm

    @property
    def means(self) -> Mapping[str, float | None]:
        """Means of the other metrics on the hidden lifts."""
        return self.hidden.means

    @property
    def trained(self) -> bool:
        """Whether it is the best known, which sees no more than a policy."""
        return self.key == BEST_KNOWN

    @functools.cached_property
    def numbers(self) -> dict[str, tuple[float, float]]:
        """Mean RMSE [mm] and ``vs_human`` on the public lifts of each behaviour, where known."""
        if self.public is None:
            return {}
        found = {}
        for behaviour in dict.fromkeys(behaviour for behaviour, _ in self.public[0].strata):
            mine, people = (each.part(behaviour) for each in self.public)
            found[behaviour] = mine.mean, mine.against(people).ratio.mean
        return found

    def mean_mm(self, behaviour: str) -> float | None:
        """Return the mean RMSE [mm] on the public lifts of a behaviour."""
        mean, _ = self.numbers.get(behaviour, (None, None))
        return mean


def references_of(board: Board, info: SeasonInfo) -> tuple[SeasonReference, ...]:
    """Return the references of a season; none until they have been played on its hidden lifts."""
    suite = season_suite(info)
    baselines = None if suite is None else shipped_baselines(suite)
    shipped = (None if suite is None else shipped_references(suite)) or {}
    return tuple(
        SeasonReference(
            key=name,
            hidden=scores,
            public=(shipped[name], baselines[HUMAN_HUMAN])
            if baselines is not None and name in shipped
            else None,
        )
        for name, scores in board.references(info.name).items()
    )
