"""A proportional controller for the NAO at one end of the table; a human lifts the other.

Ten times a second it observes five numbers and returns how far the robot's hands should move.
Try it with ``colift check``, change it, and try again.
"""

from pathlib import Path

import numpy as np
from colift.agents.agent import RobotObservation

# Weights, if there are any, lie beside this file: np.load(HERE / "weights.npz").
HERE = Path(__file__).parent


class Policy:
    """Removes a fixed share of the observed height difference."""

    gain = 1.8  # 1 moves to where the human was; more moves beyond, since the human moves on

    def reset(self, seed: int) -> None:
        """Begin a lift: forget the last one. Random numbers, if any, are drawn from ``seed``."""

    def act(self, observation: np.ndarray) -> float:
        """Return the change of the hands' height [m] in this step, up is positive.

        The hands move at most 0.04 m in a step; a larger change is clipped.
        """
        human = observation[RobotObservation.HUMAN_END]  # where the human's end was 0.1 s ago
        hand = observation[RobotObservation.HAND_HEIGHT]  # where the robot's hands are now
        # There are also ROBOT_END, HAND_COMMAND and TIME; heights are in m from the start.
        return float(self.gain * (human - hand))
