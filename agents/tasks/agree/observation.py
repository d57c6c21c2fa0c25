"""The layout of the robot's observation in the task ``agree``, and its own senses."""

from enum import IntEnum
from typing import Final

from colift.agents.senses import HEIGHT_BOUND, LONGEST_EPISODE, Sense

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


class AgreeObservation(IntEnum):
    """Index table of the robot's observation in the task ``agree``: touch, and its own hurdle.

    The four numbers of the hurdle are 0 if the robot has none.
    """

    HUMAN_END = 0
    """As in :class:`.HapticObservation`, and so on."""
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
