"""Observation and action spaces of the agents."""

from typing import Final

import numpy as np
from gymnasium.spaces import Box

from ...agents.agent import FRAME, HumanObservation, RobotObservation
from ..lift import HAND_SPEED, REFERENCE_RANGE
from ..scenario import LONGEST_PERIOD

HEIGHT_BOUND: Final = 2.0
"""Bound of every height in an observation [m]; a lift stays far inside it."""

VELOCITY_BOUND: Final = 50.0
FORCE_BOUND: Final = 1e4

LONGEST_EPISODE: Final = 120.0
"""Bound of the time in an observation [s]."""


def robot_action_space(control_period: float) -> Box:
    """Return the robot's actions: the change of its hand command in one period [m]."""
    limit = HAND_SPEED * control_period
    return Box(-limit, limit, (1,), np.float64)


def human_action_space(frames: int) -> Box:
    """Return a human's actions: a hand reference for each of the step's frames [m]."""
    return Box(*REFERENCE_RANGE, (frames,), np.float64)


def robot_observation_space() -> Box:
    """Return the robot's observations, laid out as :class:`.RobotObservation`."""
    bound = np.full(len(RobotObservation), HEIGHT_BOUND)
    low = -bound
    bound[RobotObservation.TIME] = LONGEST_EPISODE + LONGEST_PERIOD
    low[RobotObservation.TIME] = 0.0
    return Box(low, bound, dtype=np.float64)


def human_observation_space(frames: int) -> Box:
    """Return a human's observations, laid out as :class:`.HumanObservation`."""
    bound = np.full(HumanObservation.size(frames), HEIGHT_BOUND)
    bound[HumanObservation.OWN_VELOCITY] = VELOCITY_BOUND
    bound[HumanObservation.HAND_FORCE] = FORCE_BOUND
    low = -bound
    bound[HumanObservation.TIME] = LONGEST_EPISODE + FRAME
    low[HumanObservation.TIME] = 0.0
    return Box(low, bound, dtype=np.float64)
