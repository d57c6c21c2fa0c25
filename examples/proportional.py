"""A policy of your own: run it with ``colift run examples/proportional.py:Proportional``.

It is what ``colift run proportional`` runs. All that a robot may see is in ``RobotObservation``;
what it should not keep from one lift to the next, it forgets in ``reset``.
"""

import numpy as np
from colift.agents.agent import RobotObservation


class Proportional:
    """Takes away a fixed share of the height difference that it sees."""

    gain = 1.8

    def reset(self, seed: int) -> None:
        """Begin an episode."""

    def act(self, observation: np.ndarray) -> np.ndarray:
        """Return the change of the hand command [m]."""
        human = observation[RobotObservation.HUMAN_END]
        hand = observation[RobotObservation.HAND_HEIGHT]
        return np.array([self.gain * (human - hand)])
