"""A level table by touch: the control that does not ask what the human means."""

import numpy as np

from ..agent import Action, Observation
from ..observations import HapticObservation
from ..touch.touch import touched


class TouchLevel:
    """Keeps the table level, with the torque at its hands for a pitch that is not late.

    With the height z that the human's end is felt to have, and its last change d, the command
    becomes

        u = z + d.
    """

    def reset(self, seed: int) -> None:
        """Begin an episode with the table at height 0."""
        self._near = 0.0

    def act(self, observation: Observation) -> Action:
        """Return the change [m] that brings the command to the height that is level next."""
        near = touched(observation).near
        command, self._near = 2 * near - self._near, near
        return np.array([command - observation[HapticObservation.HAND_COMMAND]])
