"""The metrics that a board shows beside RMSE: means of a run, and their order in a table."""

import functools
from collections.abc import Mapping
from typing import Any, Final

from ...agents.registry import SUITES, entries
from ...benchmark.episode.level import LEVEL
from ...benchmark.episode.metric import Metric, on_boards
from ...benchmark.statistics import MeanWithMissing
from ...benchmark.suites.suite import make_suite

_MISSING: Final = 1000.0
"""Weight of a missing value in a sort key: more than any mean."""


@functools.cache
def board_metrics(suite: str) -> tuple[Metric, ...]:
    """Return the metrics that have a column on boards of a suite, in their order.

    They are those of the suite's task; of ``level``, if no suite of that name is registered.
    """
    metrics = make_suite(suite).metrics if suite in entries(SUITES) else LEVEL.metrics
    return on_boards(metrics)


def read_means(content: Mapping[str, Any], suite: str) -> dict[str, MeanWithMissing]:
    """Return the means of a suite's :func:`board_metrics` by name, from JSON with other entries."""
    return {
        metric.name: MeanWithMissing(**content[metric.name])
        for metric in board_metrics(suite)
        if metric.name in content
    }


def sort_key(metric: Metric, found: MeanWithMissing) -> float | None:
    """Return the place of a mean in a table that begins with the best; None is last."""
    if found.mean is None:
        return None
    key = {"less": found.mean, "more": -found.mean, "near zero": abs(found.mean)}[metric.better]
    return key + (_MISSING * found.missing if metric.missing == "worst" else 0.0)
