"""The table by touch: its pitch, and the other end's height without delay."""

import math
from typing import Final, NamedTuple

from colift.agents.agent import Observation
from colift.agents.tasks.touch.observation import HapticObservation

TABLE_LENGTH: Final = 0.8
"""Distance between the two grips [m], as measured on colift's table."""

WRIST_STIFFNESS: Final = 10.0
"""Pitch stiffness of a person's two wrists [Nm/rad]."""

FAR_STIFFNESS: Final = 1.0
"""Pitch stiffness of the robot's grip [Nm/rad]."""


class Touched(NamedTuple):
    """The table as the robot's hands feel it."""

    pitch: float
    """Pitch of the table [rad], positive if the robot's end is higher."""
    near: float
    """Height of the human's end [m]."""
    force: float
    """Force of the robot's hands on the table beyond half of its weight [N]."""


def touched(observation: Observation) -> Touched:
    """Return the table as felt: the grip's torque is its stiffness times the pitch.

    Touch has no delay, whereas motion capture is one latency old.
    """
    pitch = -float(observation[HapticObservation.TORQUE]) / FAR_STIFFNESS
    hand = float(observation[HapticObservation.HAND_HEIGHT])
    near = hand - TABLE_LENGTH * math.sin(pitch)
    return Touched(pitch, near, float(observation[HapticObservation.FORCE]))
