"""A tray with a full bowl."""

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
            name="margin_mm",
            symbol="margin",
            label="Margin",
            unit="mm",
            digits=1,
            better="more",
            shown="board",
            meaning="smallest distance of the height difference from the one that spills the bowl",
        ),
    )
)


@dataclass(frozen=True, kw_only=True)
class Tray(Level):
    """Keep a tray level on which a full bowl stands."""

    name: ClassVar[str] = "tray"
    metrics: ClassVar[Metrics] = METRICS

    spill: float = 0.045
    """Height difference of the ends above which the bowl spills [m]."""

    def rewards(self, lift):
        """Return minus the share of the height that spills, squared, for both agents."""
        gap = lift.world.human_end[-1] - lift.world.robot_end[-1]
        reward = -((gap / self.spill) ** 2)
        return reward, reward

    def failure(self, lift):
        """Return why the lift ends after the step just made, or None if it goes on."""
        if abs(lift.world.human_end[-1] - lift.world.robot_end[-1]) > self.spill:
            return f"the bowl spills: the ends differ by more than {1000 * self.spill:.0f} mm"
        return super().failure(lift)

    def series(self, lift):
        """Return the height difference [m] in each frame, for the trace."""
        human, robot = np.array(lift.world.human_end), np.array(lift.world.robot_end)
        before = len(human) - lift.frame  # the world also has frames from before the lift
        return {"gap": (human - robot)[before:]}

    def score(self, lift, trace, *, failed):
        """Return the scores of the task ``level``, and the margin."""
        worst = float(np.abs(trace.human_end - trace.robot_end).max(initial=0.0))
        margin = 1000 * (self.spill - worst)
        return {**super().score(lift, trace, failed=failed), "margin_mm": margin}


def tray_v1() -> Suite:
    """8 lifts of a tray with a full bowl."""
    scenarios = tuple(
        make_scenario(behaviour, subject, task="tray")
        for behaviour in ("smooth", "pause")
        for subject in ("S1", "S4")
    )
    return Suite(name="tray-v1", scenarios=scenarios, seeds=(0, 1))
