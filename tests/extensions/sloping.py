"""A laboratory's own task, suite, behaviour and metric: one module and three entry points."""

import dataclasses
from dataclasses import dataclass

import numpy as np
from colift.agents.humans import Smooth
from colift.benchmark.episode.metric import Metric, metric_table
from colift.benchmark.episode.metrics import rmse_mm
from colift.benchmark.suites.suite import Suite, make_suite
from colift.benchmark.tasks.level.task import Level

ENTRY_POINTS = """\
[colift.tasks]
slope = sloping:Slope
[colift.suites]
slope-v1 = sloping:slope
[colift.humans]
shy = sloping:Shy
"""


@dataclass(frozen=True, kw_only=True)
class Slope(Level):
    """Keep the table at a slope: the human's end higher than the robot's."""

    rise: float = 0.04
    """Height of the human's end above the robot's [m]."""

    name = "slope"
    metrics = metric_table(
        (
            *Level.metrics.values(),
            Metric(
                name="slope_error_mm",
                symbol="slope",
                label="Slope error",
                unit="mm",
                shown="board",
                meaning="largest deviation of the height difference from the slope",
            ),
        )
    )

    def rewards(self, lift):
        """Return minus the deviation from the slope [m], for both."""
        world = lift.world
        reward = -abs(world.human_end[-1] - world.robot_end[-1] - self.rise)
        return reward, reward

    def series(self, lift):
        """Return the height at which the robot's end should be [m]."""
        return {"wanted": lift.target[: lift.frame] - self.rise}

    def score(self, lift, trace, *, failed):
        """Return the scores, with the error measured from the slope."""
        level = trace.robot_end + self.rise
        worst = float(np.abs(trace.human_end - level).max(initial=0.0))
        return {
            **super().score(lift, trace, failed=failed),
            "rmse_mm": rmse_mm(trace.human_end, level, horizon=lift.horizon),
            "slope_error_mm": 1000 * worst,
        }


def slope():
    """12 lifts at a slope of 40 mm."""
    quick = make_suite("quick-v1")
    scenarios = tuple(dataclasses.replace(each, task=Slope()) for each in quick.scenarios)
    return Suite(name="slope-v1", scenarios=scenarios, seeds=quick.seeds)


@dataclass(frozen=True, kw_only=True)
class Shy(Smooth):
    """Lifts to half the height, and puts down again."""

    def plan(self, subject, seed):
        """Return the plan of one episode."""
        plan = super().plan(subject, seed)
        target = np.maximum(0.5, 0.08 / plan.goal) * plan.target
        target.flags.writeable = False
        return dataclasses.replace(plan, target=target, goal=float(target.max()))
