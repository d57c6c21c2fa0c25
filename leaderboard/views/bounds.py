"""The bounds beside a table, on the public lifts."""

import functools
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from colift.benchmark.results.baselines import (
    HUMAN_HUMAN,
    shipped_baselines,
    shipped_bounds,
)
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.statistics import Estimate
from colift.benchmark.suites.suite import Suite
from colift.leaderboard.records.metrics import known_means
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.views.suites import season_suite

MEANINGS: Final[Mapping[str, str]] = {
    "causal_bound": "sees what a policy sees, predicts as well as has been learned so far, and "
    "spends nothing on smoothness",
    "oracle": "knows where the person is going, and rehearses the lift",
}
"""Description of each bound, in display order."""


@dataclass(frozen=True, kw_only=True)
class PublicBound:
    """A bound on the public lifts; it is not a policy and has no rank."""

    name: str
    meaning: str
    scores: ScoreTable
    human_human: ScoreTable
    """The human-human baseline on the same lifts."""
    means: Mapping[str, float | None]
    """Means of the other metrics that boards show."""

    @property
    def rmse_mm(self) -> Estimate:
        """Mean RMSE [mm]."""
        return self.scores.error

    @property
    def causal(self) -> bool:
        """Whether it sees no more than a policy."""
        return self.name == "causal bound"

    @functools.cached_property
    def numbers(self) -> dict[str, tuple[float, float]]:
        """Mean RMSE [mm] and ``vs_human`` on each behaviour."""
        found = {}
        for behaviour in dict.fromkeys(behaviour for behaviour, _ in self.scores.strata):
            mine, people = (each.part(behaviour) for each in (self.scores, self.human_human))
            found[behaviour] = mine.mean, mine.against(people).ratio.mean
        return found

    def mean_mm(self, behaviour: str) -> float:
        """Return the mean RMSE [mm] on a behaviour."""
        return self.scores.part(behaviour).mean


def bounds_of(info: SeasonInfo) -> tuple[PublicBound, ...]:
    """Return the bounds of a season's public lifts; none if its suite has none."""
    suite = season_suite(info)
    return () if suite is None else _bounds(suite)


@functools.lru_cache(maxsize=8)
def _bounds(suite: Suite) -> tuple[PublicBound, ...]:
    baselines, found = shipped_baselines(suite), shipped_bounds(suite)
    if baselines is None or found is None:
        return ()
    return tuple(
        PublicBound(
            name=name.replace("_", " "),
            meaning=meaning,
            scores=found[name],
            human_human=baselines[HUMAN_HUMAN],
            means=known_means(found[name].means, suite.name),
        )
        for name, meaning in MEANINGS.items()
        if name in found
    )
