"""The layouts of the robot's observations in tasks with touch: version 2.

They begin with the five numbers of version 1, :class:`.RobotObservation`, so that a policy that
reads those by name also plays here.
"""

from enum import IntEnum
from typing import Final

from colift.agents.senses import HEIGHT_BOUND, LONGEST_EPISODE, MOCAP_NOISE, Sense

HURDLE_SENSES: Final = (
    Sense(
        "hurdle_height",
        -HEIGHT_BOUND,
        HEIGHT_BOUND,
        "height that the table has to pass [m]",
        scale=10.0,
    ),
    Sense(
        "hurdle_start",
        -LONGEST_EPISODE,
        LONGEST_EPISODE,
        "time until the window for it opens [s]; negative once it is open",
        scale=0.5,
    ),
    Sense(
        "hurdle_stop",
        -LONGEST_EPISODE,
        LONGEST_EPISODE,
        "time until it closes [s]; negative once it is closed",
        scale=0.5,
    ),
    Sense("hurdle_given", -1.0, 1.0, "1 if the robot has a hurdle in this lift, 0 if not"),
)
"""The senses of the task ``agree`` besides sight and touch; all 0 without a hurdle."""

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


class AgreeObservation(IntEnum):
    """Index table of the robot's observation in the task ``agree``: touch, and its own hurdle.

    The four numbers of the hurdle are 0 if the robot has none.
    """

    HUMAN_END = 0
    """As in :class:`HapticObservation`, and so on."""
    ROBOT_END = 1
    HAND_HEIGHT = 2
    HAND_COMMAND = 3
    TIME = 4
    FORCE = 5
    TORQUE = 6
    HURDLE_HEIGHT = 7
    """Height that the table has to pass [m]."""
    HURDLE_START = 8
    """When the window of time for it opens, from now [s]; negative once it is open."""
    HURDLE_STOP = 9
    """When it closes, from now [s]; negative once it is closed."""
    HURDLE_GIVEN = 10
    """1 if the robot has a hurdle in this lift, 0 if not."""


class BallObservation(IntEnum):
    """Index table of the observation with a ball: touch, the ball, and its target if it is known.

    The first seven numbers are those of :class:`HapticObservation`.
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
