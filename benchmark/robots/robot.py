"""The declaration of a robot: its body in the world, its reach and speed, its picture."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Final, Protocol

from colift.base.plugins import make_registered, object_fault
from colift.base.registry import ROBOTS, entries
from colift.benchmark.world.interface import FarEnd

DEFAULT_ROBOT: Final = "nao"
"""The default robot, that of the paper."""

Place = tuple[float, float, float]


class Robot(FarEnd, Protocol):
    """A robot as the holder of the far end; an entry point of the group ``colift.robots``.

    It is a frozen dataclass: its fields and the code of its class are in the digest of every suite
    that it plays.
    """

    @property
    def label(self) -> str:
        """Its name in pictures."""

    @property
    def control(self) -> str:
        """The kind of its control in words, such as ``"position servos"``."""

    @property
    def stroke(self) -> tuple[float, float]:
        """Lowest and highest displacement of its hands [m]."""

    @property
    def hand_speed(self) -> float:
        """Fastest change of the hand command [m/s]."""

    def model(self) -> Path:
        """Return the URDF file of its picture."""

    @property
    def place(self) -> Place:
        """Where the base of this model is in the world [m]."""

    @property
    def foot(self) -> float:
        """Height of the lowest part of the model above its base [m]; a pedestal is below it."""

    def posture(self, height: float) -> Mapping[str, float]:
        """Return the joint angles [rad] by name for hands at a displacement [m]."""


@cache
def make_robot(name: str) -> Robot:
    """Return the robot that is registered under ``name``.

    Raises
    ------
    InputError
        If the name is unknown, or there is no robot of that name in its package.
    """
    robot: Robot = make_registered(ROBOTS, name, robot_fault)
    return robot


def robot_fault(robot: object) -> str | None:
    """Return the reason why an object is not a robot, or None."""
    return object_fault(robot, Robot)


def robot_names() -> tuple[str, ...]:
    """Return the names of all registered robots."""
    return tuple(entries(ROBOTS))
