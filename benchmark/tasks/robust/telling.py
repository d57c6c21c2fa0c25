"""What a reference is told that a policy has to find out: the sensor's delays, and the person."""

from dataclasses import dataclass

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.episode.conditions import Drawn
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.tasks.level.task import Level
from colift.benchmark.tasks.robust.habits import HABITS, habits_of
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Telling:
    """What a reference is told."""

    behaviours: tuple[str, ...]
    """The behaviours that it knows by name; of others it is told that they are none of these."""
    sensor: bool = True
    """Whether it is told the age of each sample, and the latency of the lift."""
    person: bool = True
    """Whether it is told the behaviour, the person's habits, and the usual lift."""

    @property
    def size(self) -> int:
        """Number of numbers, whether they are told or not."""
        return 2 + len(HABITS) + 2 + len(self.behaviours)

    def numbers(self, scenario: Scenario, conditions: Drawn) -> Array:
        """Return what is told at the beginning of each step, (steps + 1, size).

        All numbers are of the order of 1; what is not told is 0.
        """
        ages = 4.0 * FRAME * conditions.ages - 0.6
        latency = np.full_like(ages, 4.0 * conditions.latency - 0.6)
        subject = scenario.subject
        habits = [
            2.0 * (habit - trait.low) / (trait.high - trait.low) - 1.0
            for habit, trait in zip(habits_of(subject), HABITS.values(), strict=True)
        ]
        usual = [20.0 * (subject.amplitude - 0.24), 5.0 * (subject.duration - 2.1)]
        named = [float(scenario.behaviour == each) for each in self.behaviours]
        person = np.tile([*habits, *usual, *named], (len(ages), 1))
        sensor = np.column_stack((ages, latency))
        return np.hstack((self.sensor * sensor, self.person * person))


def is_conditioned(scenario: Scenario) -> bool:
    """Return whether a scenario has a level table and conditions."""
    return type(scenario.task) is Level and scenario.conditions is not None
