"""The policy that goes to the last seen height of the human."""

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation


class Copy:
    """Goes to the last seen height of the human's end.

    The change of the command is the seen height of the human's end minus the command; the robot
    lags by the age of the observation and by the duration of its own movement.
    """

    def reset(self, seed: int) -> None:
        """Begin an episode; there is nothing to prepare."""

    def act(self, observation: Observation) -> Action:
        """Return the change [m] that brings the command to the seen height."""
        target = observation[RobotObservation.HUMAN_END]
        return np.array([target - observation[RobotObservation.HAND_COMMAND]])
