"""The global state of a lift, for critics that are trained with it: no agent sees it."""

from enum import IntEnum

import numpy as np
from colift.agents.senses import FORCE_BOUND, HEIGHT_BOUND
from colift.benchmark.episode.lift import Lift
from colift.benchmark.tasks.level.task import VELOCITY_BOUND
from gymnasium.spaces import Box
from numpy.typing import NDArray


class TrueState(IntEnum):
    """Index table of the numbers at the beginning of a state: true, now, and without noise."""

    HUMAN_END = 0
    """Height of the human's table end [m]."""
    ROBOT_END = 1
    """Height of the robot's table end [m]."""
    HUMAN_VELOCITY = 2
    """Velocity of the human's end [m/s]."""
    ROBOT_VELOCITY = 3
    """Velocity of the robot's end [m/s]."""
    HAND_HEIGHT = 4
    """Height of the robot's hand [m]."""
    HAND_COMMAND = 5
    """Command of the robot's hand [m]; with a second human the last reference of their hand."""
    HUMAN_FORCE = 6
    """Force of the human's hands on the table [N]."""
    ROBOT_FORCE = 7
    """Force of the robot's hands on the table [N]."""
    TARGET = 8
    """Height that the human intends now [m]."""


def true_state(lift: Lift) -> NDArray[np.float64]:
    """Return the numbers of :class:`TrueState`."""
    world = lift.world
    return np.array(
        (
            world.human_end[-1],
            world.robot_end[-1],
            world.human_velocity[-1],
            world.robot_velocity[-1],
            world.hand_height,
            lift.command,
            world.human_force[-1],
            world.robot_force[-1],
            lift.target[max(lift.frame - 1, 0)],
        )
    )


def state_space(human: Box, robot: Box) -> Box:
    """Return the space of states, from those of the two agents' observations."""
    high = np.full(len(TrueState), HEIGHT_BOUND)
    high[[TrueState.HUMAN_VELOCITY, TrueState.ROBOT_VELOCITY]] = VELOCITY_BOUND
    high[[TrueState.HUMAN_FORCE, TrueState.ROBOT_FORCE]] = FORCE_BOUND
    low = np.concatenate([-high, human.low, robot.low])
    return Box(low, np.concatenate([high, human.high, robot.high]), dtype=np.float64)
