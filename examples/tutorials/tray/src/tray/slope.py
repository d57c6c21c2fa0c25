"""A table with a slope."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from colift.agents.senses import Sense
from colift.benchmark.episode.drawn import DrawnSeries
from colift.benchmark.episode.metric import Metrics, metric_table
from colift.benchmark.episode.metrics import rmse_mm
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.level.task import Level

SLOPE_METRICS = metric_table(
    (
        replace(
            Level.metrics["rmse_mm"],
            meaning="root mean square distance of the robot's end from its goal",
        ),
        *(metric for name, metric in Level.metrics.items() if name != "rmse_mm"),
    ),
    drawn=(DrawnSeries(name="due", label="goal of the far end", goal=True),),
)


@dataclass(frozen=True, kw_only=True)
class Slope(Level):
    """Keep the human's end higher than the robot's by a height that both know."""

    name: ClassVar[str] = "slope"
    metrics: ClassVar[Metrics] = SLOPE_METRICS

    rise: float = 0.03
    """Height of the human's end above the robot's [m], at most 0.05."""

    senses: ClassVar[tuple[Sense, ...]] = (Sense("rise", 0.0, 0.05, "the wanted rise [m]"),)

    def observe(self, f, drawn, view):
        """Return the rise [m], after the five numbers of a level table."""
        return (self.rise,)

    def second_person_observation(self, lift):
        """Return the senses of a second human, who means to be lower than the end that is seen."""
        goal = lift.seen_by_second_person() - self.rise
        return lift.second_person_view(np.full(lift.frames_per_step, goal))

    def rewards(self, lift):
        """Return minus the distance of the robot's end from its goal [m], for both agents."""
        reward = -abs(lift.world.human_end[-1] - self.rise - lift.world.robot_end[-1])
        return reward, reward

    def series(self, lift):
        """Return the goal of the robot's end [m], which pictures show."""
        human = np.array(lift.world.human_end)
        return {"due": human[len(human) - lift.frame :] - self.rise}

    def score(self, lift, trace, *, failed):
        """Return the scores of the task ``level``, with the error from the goal."""
        goal = trace.human_end - self.rise
        error = rmse_mm(goal, trace.robot_end, horizon=lift.horizon)
        return {**super().score(lift, trace, failed=failed), "rmse_mm": error}


def slope_v1() -> Suite:
    """8 lifts of a table with a slope."""
    scenarios = tuple(
        make_scenario(behaviour, subject, task="slope")
        for behaviour in ("smooth", "pause")
        for subject in ("S1", "S4")
    )
    return Suite(name="slope-v1", scenarios=scenarios, seeds=(0, 1))
