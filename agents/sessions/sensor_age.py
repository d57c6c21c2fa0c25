"""The age of the motion capture's samples, found by comparison with the fresh encoders."""

from typing import Final

import numpy as np
from colift.agents.agent import FRAME, Observation, RobotObservation

USUAL: Final = 0.1
"""Age that is assumed before the first lift has ended [s]."""

OLDEST: Final = 0.5
"""Oldest age that is looked for [s]."""

MOVED: Final = 0.03
"""Range of hand heights from which an age can be told [m]."""


class SensorAge:
    """The age at which the seen heights of the own end fit the hand's heights best.

    Both ends of the table come with the same sample, and the hand's height is known without delay:
    the age L minimises the variance of

        z_r(t) - h(t - L)

    over all lifts of a session so far, on a grid of frames.
    """

    def __init__(self) -> None:
        self.seconds = USUAL
        """The age [s]."""
        self._ages = FRAME * np.arange(round(OLDEST / FRAME) + 1)
        self._squares = np.zeros(len(self._ages))
        self._samples: list[tuple[float, float, float]] = []

    def add(self, observation: Observation) -> None:
        """Add an observation of the present lift."""
        names = RobotObservation.TIME, RobotObservation.ROBOT_END, RobotObservation.HAND_HEIGHT
        time, end, hand = (float(observation[name]) for name in names)
        self._samples.append((time, end, hand))

    def end_lift(self) -> None:
        """Find the age, with the lift that has ended."""
        if len(self._samples) < 2:
            return
        times, ends, hands = np.array(self._samples).T
        self._samples = []
        if np.ptp(hands) < MOVED:
            return
        apart = ends - np.array([np.interp(times - age, times, hands) for age in self._ages])
        self._squares += ((apart - apart.mean(axis=1, keepdims=True)) ** 2).sum(axis=1)
        self.seconds = float(self._ages[int(self._squares.argmin())])
