"""The ports of the real-time loop: what it needs of a motion capture, a robot arm and a clock.

Heights are displacements [m] from the table's rest height, z up; times are seconds of the clock.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol


class Sample(NamedTuple):
    """One motion-capture frame."""

    time: float
    """When it was captured [s], on the loop's clock."""
    human_end: float
    """Height of the human's table end [m]; NaN if it was not seen."""
    robot_end: float
    """Height of the robot's table end [m]; NaN if it was not seen."""


class ArmState(NamedTuple):
    """What a robot says of its hands."""

    height: float
    """Mean height of the hands by the encoders [m]."""
    set_point: float
    """Mean height of the hands by the robot's own set-points [m]; it moves to the last command."""
    stiffness: float
    """Lowest stiffness of the arms' motors, 0 (off) to 1."""
    astray: float = 0.0
    """How far the set-point of a joint is from where this client's commands lead [rad], at most."""


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
    """The connection to the robot is lost; the message says what was noticed."""


class RobotTakenError(Exception):
    """Somebody else commands the robot; the message says who."""


class CaptureLostError(Exception):
    """The connection to the motion capture is lost for good."""


class MotionCapture(Protocol):
    """Motion capture of the table's two ends."""

    @property
    def unseen(self) -> str:
        """Which markers were not seen in the newest frame, and why; empty if all were."""

    def drain(self) -> list[Sample]:
        """Return the frames that came in since the last call, oldest first, without waiting.

        Raises
        ------
        CaptureLostError
            If no more will come.
        """

    def close(self) -> None:
        """Release the connection."""


class TableCapture(MotionCapture, Protocol):
    """Motion capture whose zero can be moved to where the table rests."""

    info: dict[str, object]
    """What it says of itself."""

    def set_rest(self, human_end: float, robot_end: float) -> None:
        """Take the present zero of the ends' heights [m] to be displaced by these."""


class Naoqi(Protocol):
    """A NAOqi whose services can be called; each raises :class:`RobotLostError` on silence."""

    url: str
    """Where it is."""

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
        """What the robot holds a command to."""

    def state(self) -> ArmState:
        """Return where the hands are.

        Raises
        ------
        RobotLostError
            If the robot does not answer.
        RobotTakenError
            If somebody else commands it.
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
            If somebody else commands it.
        """

    def stop(self) -> None:
        """Freeze the hands where they are; every later command is refused. Never raises."""


class Clock(Protocol):
    """The time of the loop."""

    def now(self) -> float:
        """Return the time [s]."""

    def wait_until(self, time: float) -> str | None:
        """Wait until a time; return early with the reason if the operator wants to stop."""
