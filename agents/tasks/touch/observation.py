"""The layout of the robot's observation with touch.

It begins with the five numbers of :class:`.RobotObservation`, so that a policy that reads those by
name also plays tasks with touch.
"""

from enum import IntEnum


class HapticObservation(IntEnum):
    """Index table of an observation with touch: version 1, and the force and torque at the hands.

    Each of the robot's wrists has a force and torque sensor; both readings are added and averaged
    over the last 50 ms.
    """

    HUMAN_END = 0
    """Height of the human's table end [m], motion capture, as old as the latency."""
    ROBOT_END = 1
    """Height of the robot's table end [m], motion capture, as old as the latency."""
    HAND_HEIGHT = 2
    """Height of the robot's hand [m], encoders, age 0."""
    HAND_COMMAND = 3
    """Command of the robot's hand [m] at the start of this step, age 0."""
    TIME = 4
    """Time since the episode began [s]."""
    FORCE = 5
    """Force of the robot's hands on the table [N], upwards positive, beyond their half of the
    table's weight."""
    TORQUE = 6
    """Torque of the robot's hands on the table [Nm], positive if it would raise the robot's end."""
