"""A policy of your own: run it with ``colift run examples/proportional.py:Proportional``."""

import numpy as np
from colift.agents.agent import RobotObservation


class Proportional:
    """Takes away a share of the height difference that it sees, in every step."""

    gain = 0.5

    def reset(self, seed: int) -> None:
        """Begin an episode."""

    def act(self, observation: np.ndarray) -> np.ndarray:
        """Return the change of the hand command [m]."""
        human = observation[RobotObservation.HUMAN_END]
        hand = observation[RobotObservation.HAND_HEIGHT]
        return np.array([self.gain * (human - hand)])
