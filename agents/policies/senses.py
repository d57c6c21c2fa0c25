"""What a robot has seen, done and felt in the last seconds, as the inputs of a learned function."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..agent import Observation, RobotObservation
from ..errors import InputError

Array = NDArray[np.float64]

ARM_LAG: Final = 0.02
"""Time by which the arm is behind its command [s]: one cycle of the NAO's motion thread."""


@dataclass(frozen=True, kw_only=True)
class Window:
    """How far back the inputs reach.

    Raises
    ------
    InputError
        If there is no velocity, or a number is out of range.
    """

    interval: float = 0.1
    """Time between the values of the past [s]."""
    velocities: int = 20
    """Past velocities of the human's end."""
    commands: int = 3
    """Own commands, the present one included."""
    sags: int = 3
    """How far the own hand was below where it was commanded, the present included."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        if not 0 < self.interval < np.inf:
            raise InputError(f"interval must be a positive time, got {self.interval}")
        if self.velocities < 1 or min(self.commands, self.sags) < 0:
            raise InputError(f"a window needs a velocity and no negative number, got {self}")

    @property
    def size(self) -> int:
        """Number of inputs."""
        return 1 + self.velocities + self.commands + self.sags


class Senses:
    """Collects observations, and makes inputs of them.

    With z the seen heights of the human's end, u the own command, s the sag, and dt the window's
    interval, the inputs are

        z(-0), z(-0) - z(-dt), z(-dt) - z(-2 dt), ...,
        u(0) - z(-0), u(-dt) - z(-0), ...,    s(0), s(-dt), ...

    with times from now, and z(-0) the newest that was seen, which is a latency old. Between two
    samples they are interpolated, before the first they are as with the first.

    The sag is how far the hand is below its command of :data:`ARM_LAG` ago. It is what the arm
    gives way under its load, and so it feels, without the latency of the eye, how the human tilts
    and moves the table just now.
    """

    def __init__(self, window: Window) -> None:
        self._window = window
        self._keep = window.interval * (window.velocities + window.commands + window.sags + 1)
        self._times: list[float] = []
        self._heights: list[float] = []
        self._commands: list[float] = []
        self._sags: list[float] = []

    def see(self, observation: Observation) -> None:
        """Take the newest observation in."""
        time = float(observation[RobotObservation.TIME])
        while len(self._times) > 1 and self._times[1] < time - self._keep:
            for values in (self._times, self._heights, self._commands, self._sags):
                del values[0]
        self._times.append(time)
        self._heights.append(float(observation[RobotObservation.HUMAN_END]))
        self._commands.append(float(observation[RobotObservation.HAND_COMMAND]))
        expected = float(np.interp(time - ARM_LAG, self._times, self._commands))
        self._sags.append(expected - float(observation[RobotObservation.HAND_HEIGHT]))

    @property
    def time(self) -> float:
        """The time of the newest observation [s]."""
        return self._times[-1]

    @property
    def height(self) -> float:
        """The newest seen height of the human's end [m]."""
        return self._heights[-1]

    @property
    def sag(self) -> float:
        """How far the hand is below its command now [m]."""
        return self._sags[-1]

    def period(self, default: float) -> float:
        """Return the time between the last two observations [s]; the default before."""
        return self._times[-1] - self._times[-2] if len(self._times) > 1 else default

    def command(self, age: float) -> float:
        """Return the own command of that long ago [m]."""
        return float(np.interp(self._times[-1] - age, self._times, self._commands))

    def inputs(self) -> Array:
        """Return the inputs, shape ``(window.size,)`` [m]."""
        window, times = self._window, self._times
        ages = window.interval * np.arange(max(window.size, 2))
        ago = times[-1] - ages
        heights = np.interp(ago[: window.velocities + 1], times, self._heights)
        commands = np.interp(ago[: window.commands], times, self._commands)
        sags = np.interp(ago[: window.sags], times, self._sags)
        return np.concatenate(
            (heights[:1], heights[:-1] - heights[1:], commands - heights[0], sags)
        )
