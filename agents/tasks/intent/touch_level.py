"""A level table by touch, without regard to the human's intention."""

from typing import ClassVar

import numpy as np
from colift.agents.agent import Action, Observation
from colift.agents.tasks.touch.observation import HapticObservation
from colift.agents.tasks.touch.touched import touched


class TouchLevel:
    """Keeps the table level, with a pitch that the torque at its hands gives without delay.

    With the felt height z of the human's end, and its last change d, the command becomes

        u = z + d.
    """

    alone: ClassVar[bool] = True
    """It departs from level by its own knowledge alone, whatever the partner does."""

    def reset(self, seed: int) -> None:
        """Begin an episode with the table at height 0."""
        self._near = 0.0

    def act(self, observation: Observation) -> Action:
        """Return the change [m] that brings the command to the next level height."""
        near = touched(observation).near
        command, self._near = 2 * near - self._near, near
        return np.array([command - observation[HapticObservation.HAND_COMMAND]])
