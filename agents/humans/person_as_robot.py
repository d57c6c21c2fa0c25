"""A person in the place of a robot policy."""

import numpy as np
from colift.agents.actions import action_limit
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.humans.hand_log import Hand


class PersonAsRobot:
    """Commands the robot by a hand: one command per control period, towards the hand's height.

    As for a policy, the robot's arm, period, speed and stroke apply. Each step uses the hand's last
    reference before it.

    Parameters
    ----------
    hand
        The person's hand.
    frames
        Frames in a step.
    period
        Control period [s].
    """

    def __init__(self, hand: Hand, frames: int, period: float) -> None:
        self._hand = hand
        self._frames = frames
        self._limit = action_limit(period)
        self._begun = False

    def reset(self, seed: int) -> None:
        """Begin an episode; nothing is random."""
        self._begun = False

    def act(self, observation: Observation) -> Action:
        """Return the change of the command towards the hand, as far as the robot can go [m]."""
        height = 0.0
        for _ in range(self._frames if self._begun else 0):
            height = self._hand.next()
        self._begun = True
        change = height - float(observation[RobotObservation.HAND_COMMAND])
        return np.array([min(max(change, -self._limit), self._limit)])
