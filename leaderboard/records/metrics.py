"""The metrics that a board shows beside RMSE: means of a run, and their order in a table."""

import functools
from collections.abc import Mapping
from typing import Any, Final

from colift.base.registry import SUITES, entries
from colift.benchmark.episode.metric import LEADING, Metric, Metrics, on_boards, second_axis
from colift.benchmark.statistics import MeanWithMissing
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.level.task import LEVEL

_MISSING: Final = 1000.0
"""Weight of a missing value in a sort key: more than any mean."""


@functools.cache
def suite_metrics(suite: str) -> Metrics:
    """Return the metrics of a suite's task; of ``level``, if no suite of that name is registered.

    A season is of a registered suite, and the name of its hidden lifts is that of the public ones.
    """
    return make_suite(suite).metrics if suite in entries(SUITES) else LEVEL.metrics


def board_metrics(suite: str) -> tuple[Metric, ...]:
    """Return the metrics that have a column on boards of a suite, in their order."""
    return on_boards(suite_metrics(suite))


def picture_axes(suite: str) -> tuple[Metric, Metric]:
    """Return the leading metric of a suite, and the second one of its pictures."""
    metrics = suite_metrics(suite)
    return metrics[LEADING], second_axis(metrics)


def read_means(content: Mapping[str, Any], suite: str, episodes: int) -> dict[str, MeanWithMissing]:
    """Return the means of a suite's :func:`board_metrics` by name, from JSON with other entries.

    A metric that is newer than the content is missing in all of its ``episodes``.
    """
    newer = {"mean": None, "missing": episodes}
    return {
        metric.name: MeanWithMissing(**content.get(metric.name, newer))
        for metric in board_metrics(suite)
    }


def known_means(means: Mapping[str, float | None], suite: str) -> dict[str, float | None]:
    """Return a baseline's means of a suite's :func:`board_metrics`; None for a newer metric."""
    return {metric.name: means.get(metric.name) for metric in board_metrics(suite)}


def sort_key(metric: Metric, found: MeanWithMissing) -> float | None:
    """Return the sort key of a mean in a table that begins with the best; None is last."""
    if found.mean is None:
        return None
    key = {"less": found.mean, "more": -found.mean, "near zero": abs(found.mean)}[metric.better]
    return key + (_MISSING * found.missing if metric.missing == "worst" else 0.0)
