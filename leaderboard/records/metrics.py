"""The metrics that a board shows beside RMSE: means of a run, and their order in a table."""

from collections.abc import Mapping
from typing import Any, Final

from ...benchmark.episode.level import LEVEL
from ...benchmark.episode.metric import Metric, on_boards
from ...benchmark.statistics import MeanWithMissing

_MISSING: Final = 1000.0
"""Weight of a missing value in a sort key: more than any mean."""


def board_metrics() -> tuple[Metric, ...]:
    """Return the metrics that have a column on boards, in their order."""
    return on_boards(LEVEL.metrics)


def read_means(content: Mapping[str, Any]) -> dict[str, MeanWithMissing]:
    """Return the means of these metrics by name, from JSON that has more or less of a run."""
    return {
        metric.name: MeanWithMissing(**content[metric.name])
        for metric in board_metrics()
        if metric.name in content
    }


def sort_key(metric: Metric, found: MeanWithMissing) -> float | None:
    """Return the place of a mean in a table that begins with the best; None is last."""
    if found.mean is None:
        return None
    key = {"less": found.mean, "more": -found.mean, "near zero": abs(found.mean)}[metric.better]
    return key + (_MISSING * found.missing if metric.missing == "worst" else 0.0)
