"""The references beside a table, on the public lifts."""

import functools
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from colift.benchmark.results.baselines import (
    BEST_KNOWN,
    HUMAN_HUMAN,
    reference_label,
    shipped_baselines,
    shipped_references,
)
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.statistics import Estimate
from colift.benchmark.suites.suite import Suite
from colift.leaderboard.records.metrics import known_means
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.views.suites import season_suite

MEANINGS: Final[Mapping[str, str]] = {
    BEST_KNOWN: "sees what a policy sees; trained longer, for a small error alone: the least "
    "error known so far",
    "oracle": "knows where the person is going, and rehearses the lift",
}
"""Description of each reference, in display order."""


@dataclass(frozen=True, kw_only=True)
class PublicReference:
    """A reference on the public lifts; it is not a policy and has no rank."""

    key: str
    """Its name in the shipped file."""
    meaning: str
    scores: ScoreTable
    human_human: ScoreTable
    """The human-human baseline on the same lifts."""
    means: Mapping[str, float | None]
    """Means of the other metrics that boards show."""

    @property
    def name(self) -> str:
        """Its name on pages."""
        return reference_label(self.key)

    @property
    def rmse_mm(self) -> Estimate:
        """Mean RMSE [mm]."""
        return self.scores.error

    @property
    def trained(self) -> bool:
        """Whether it sees no more than a policy."""
        return self.key == BEST_KNOWN

    def mean_mm(self, behaviour: str) -> float:
        """Return the mean RMSE [mm] on a behaviour."""
        return self.scores.part(behaviour).mean


def references_of(info: SeasonInfo) -> tuple[PublicReference, ...]:
    """Return the references of a season's public lifts; none if its suite has none."""
    suite = season_suite(info)
    return () if suite is None else _references(suite)


@functools.lru_cache(maxsize=8)
def _references(suite: Suite) -> tuple[PublicReference, ...]:
    baselines, found = shipped_baselines(suite), shipped_references(suite)
    if baselines is None or found is None:
        return ()
    return tuple(
        PublicReference(
            key=name,
            meaning=meaning,
            scores=found[name],
            human_human=baselines[HUMAN_HUMAN],
            means=known_means(found[name].means, suite.name),
        )
        for name, meaning in MEANINGS.items()
        if name in found
    )
