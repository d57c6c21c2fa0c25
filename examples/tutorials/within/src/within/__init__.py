"""The share of a lift in which the table is level to within 10 mm."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from colift.benchmark.episode.metric import Metric, Metrics, metric_table
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.level.task import Level

METRICS = metric_table(
    (
        *Level.metrics.values(),
        Metric(
            name="within_10_mm",
            symbol="within",
            label="Within 10 mm",
            better="more",
            shown="board",
            meaning="share of the frames in which the ends differ by less than 10 mm",
        ),
    )
)


@dataclass(frozen=True, kw_only=True)
class Within(Level):
    """Keep the table level, with the share of level frames as a metric."""

    name: ClassVar[str] = "within"
    metrics: ClassVar[Metrics] = METRICS

    def score(self, lift, trace, *, failed):
        """Return the scores of the task ``level``, and the share of level frames."""
        close = np.abs(trace.human_end - trace.robot_end) < 0.01
        share = float(close.mean()) if len(close) else float("nan")
        return {**super().score(lift, trace, failed=failed), "within_10_mm": share}


def within_v1() -> Suite:
    """8 lifts of two people, scored with the share of level frames."""
    scenarios = tuple(
        make_scenario(behaviour, subject, task="within")
        for behaviour in ("smooth", "pause")
        for subject in ("S1", "S4")
    )
    return Suite(name="within-v1", scenarios=scenarios, seeds=(0, 1))
