"""The layout of the robot's observation in the task ``ball``, and its own senses."""

from enum import IntEnum
from typing import Final

from colift.agents.senses import HEIGHT_BOUND, MOCAP_NOISE, Sense

BALL_SENSES: Final = (
    Sense(
        "ball_place",
        -HEIGHT_BOUND,
        HEIGHT_BOUND,
        "place of the ball along the table [m], from the middle towards the robot: motion capture",
        MOCAP_NOISE,
        role="ball",
        scale=5.0,
        rate=50.0,
    ),
    Sense(
        "target_place",
        -HEIGHT_BOUND,
        HEIGHT_BOUND,
        "the place where the ball should be [m]; 0 if only the human knows it",
        scale=5.0,
    ),
    Sense("target_known", 0.0, 1.0, "1 if the robot knows the target, else 0"),
)
"""The senses of the task ``ball`` besides sight and touch."""


class BallObservation(IntEnum):
    """Index table of the observation with a ball: touch, the ball, and its target if it is known.

    The first seven numbers are those of :class:`.HapticObservation`.
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
    BALL_PLACE = 7
    """Place of the ball along the table [m], from the middle towards the robot; motion capture, as
    old as the latency."""
    TARGET_PLACE = 8
    """The place where the ball should be [m], age 0; 0 if only the human knows it."""
    TARGET_KNOWN = 9
    """1 if the robot knows the target, else 0."""
