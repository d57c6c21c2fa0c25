"""Interfaces of the real-time loop: motion capture, robot arm and clock.

Heights are displacements [m] from the table's rest height, z up; times are seconds of the clock.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol


class Sample(NamedTuple):
    """One motion-capture frame."""

    time: float
    """Time of capture [s], on the loop's clock."""
    human_end: float
    """Height of the human's table end [m]; NaN if it was not seen."""
    robot_end: float
    """Height of the robot's table end [m]; NaN if it was not seen."""


class ArmState(NamedTuple):
    """State of the hands as reported by the robot."""

    height: float
    """Mean height of the hands by the encoders [m]."""
    set_point: float
    """Mean height of the hands by the robot's own set-points [m]; it moves to the last command."""
    stiffness: float
    """Lowest stiffness of the arms' motors, 0 (off) to 1."""
    astray: float = 0.0
    """Largest distance of a joint's set-point from the path of this client's commands [rad]."""
    late: bool = False
    """Whether such set-points are those of an earlier command: it was carried out late."""


@dataclass(frozen=True, kw_only=True)
class HandLimits:
    """Limits of a hand command."""

    low: float
    """Lowest height [m]."""
    high: float
    """Highest height [m]."""
    speed: float
    """Highest speed [m/s]."""
    tilt: float
    """Largest difference in height of the table's ends [m]."""


class RobotLostError(Exception):
    """The connection to the robot is lost; the message has the symptom."""


class RobotTakenError(Exception):
    """Another client commands the robot; the message names it."""


class CaptureLostError(Exception):
    """The connection to the motion capture is lost for good."""


class MotionCapture(Protocol):
    """Motion capture of the table's two ends."""

    @property
    def unseen(self) -> str:
        """Markers not seen in the newest frame, with the reason; empty if all were seen."""

    def drain(self) -> list[Sample]:
        """Return the frames received since the last call, oldest first, without waiting.

        Raises
        ------
        CaptureLostError
            If no more will come.
        """

    def close(self) -> None:
        """Release the connection."""


class TableCapture(MotionCapture, Protocol):
    """Motion capture whose zero can be set to the table's rest."""

    info: dict[str, object]
    """Its description of itself."""

    def set_rest(self, human_end: float, robot_end: float) -> None:
        """Subtract these heights [m] from the ends' heights."""


class Naoqi(Protocol):
    """A NAOqi; a call without an answer raises :class:`RobotLostError`."""

    url: str
    """Its address."""

    def has(self, service: str) -> bool:
        """Return whether it offers a service."""

    def call(self, service: str, method: str, *arguments: Any, within: float = ...) -> Any:
        """Call a method and return its result, waiting at most ``within`` [s]."""

    def calls(
        self, service: str, calls: Sequence[tuple[Any, ...]], *, within: float = ...
    ) -> list[Any]:
        """Make several calls at the same time and return their results."""


class RobotArm(Protocol):
    """A robot's two hands, which move together along the vertical."""

    @property
    def limits(self) -> HandLimits:
        """Limits to which the robot clips a command."""

    def state(self) -> ArmState:
        """Return the state of the hands.

        Raises
        ------
        RobotLostError
            If the robot does not answer.
        RobotTakenError
            If another client commands it.
        """

    def command(self, height: float, duration: float) -> float:
        """Move the hands to a height [m] within a ``duration`` [s]; return at once.

        Returns
        -------
        float
            The height that was commanded [m]: the wanted one, clipped to the limits.

        Raises
        ------
        RobotLostError
            If the robot does not answer.
        RobotTakenError
            If another client commands it.
        """

    def stop(self) -> None:
        """Freeze the hands in place; every later command is refused. Never raises."""


class Clock(Protocol):
    """The time of the loop."""

    def now(self) -> float:
        """Return the time [s]."""

    def wait_until(self, time: float) -> str | None:
        """Wait until a time; return early with the reason if the operator stops the trial."""
