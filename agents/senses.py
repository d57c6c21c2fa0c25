"""The senses of a robot as data: names, ranges and meanings of an observation's numbers.

Bounds, noise, spaces, documentation and the inputs of a network follow from them.
"""

from enum import IntEnum
from typing import Final, NamedTuple, cast

HEIGHT_BOUND: Final = 2.0
"""Bound of every height in an observation [m]; a lift stays far inside it."""

FORCE_BOUND: Final = 1e4
"""Bound of every force in an observation [N]."""

LONGEST_EPISODE: Final = 120.0
"""Bound of the time in an observation [s]; a step of at most 0.5 s may end beyond it."""

MOCAP_NOISE: Final = 0.00023
"""Standard deviation of a motion-capture height [m]; the system of the paper is precise within
0.7 mm (section II.A), read as three standard deviations."""

FORCE_NOISE: Final = 0.05
"""Standard deviation of a sensed force [N], see :class:`.HapticObservation`: an assumption, some
ten times the resolution of small six-axis sensors, to include the effect of a wrist's own
motion."""

TORQUE_NOISE: Final = 0.002
"""Standard deviation of a sensed torque [Nm]."""


class Sense(NamedTuple):
    """A number of an observation."""

    name: str
    low: float
    high: float
    """Its bounds."""
    meaning: str
    noise: float = 0.0
    """Standard deviation of its error."""
    role: str = ""
    """Name of the seed of its error; by default the sense's own."""
    scale: float = 1.0
    """Factor that brings it to the order of 1, for a network."""
    rate: float = 0.0
    """The same for its change in a step; with 0 a network does not get the change."""

    @property
    def inputs(self) -> int:
        """Number of a network's inputs."""
        return 2 if self.rate else 1


SIGHT: Final = (
    Sense(
        "human_end",
        -HEIGHT_BOUND,
        HEIGHT_BOUND,
        "height of the human's table end [m]: motion capture, as old as the latency",
        MOCAP_NOISE,
    ),
    Sense("robot_end", -HEIGHT_BOUND, HEIGHT_BOUND, "that of the robot's table end", MOCAP_NOISE),
    Sense("hand_height", -HEIGHT_BOUND, HEIGHT_BOUND, "height of the robot's hand [m]: encoders"),
    Sense("hand_command", -HEIGHT_BOUND, HEIGHT_BOUND, "command of the robot's hand [m]"),
    Sense("time", 0.0, LONGEST_EPISODE + 0.5, "time since the episode began [s]"),
)
"""The senses of all tasks: :class:`.RobotObservation`."""

TOUCH: Final = (
    Sense(
        "force",
        -FORCE_BOUND,
        FORCE_BOUND,
        "force of the robot's hands on the table beyond half of its weight [N], upwards",
        FORCE_NOISE,
    ),
    Sense(
        "torque",
        -FORCE_BOUND,
        FORCE_BOUND,
        "torque of these hands [Nm], positive if it would raise the robot's end",
        TORQUE_NOISE,
    ),
)
"""The senses of tasks with touch: :class:`.HapticObservation` has those of sight before them."""


def layout(senses: tuple[Sense, ...], *, touch: bool = True) -> type[IntEnum]:
    """Return the index table of an observation: sight, touch, and a task's own senses."""
    every = (*SIGHT, *(TOUCH if touch else ()), *senses)
    members = [(each.name.upper(), index) for index, each in enumerate(every)]
    return cast(type[IntEnum], IntEnum("Observation", members))
