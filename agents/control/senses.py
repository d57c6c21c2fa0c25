"""What a robot has seen of the human in the last seconds, as the inputs of a learned function."""

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

    def __post_init__(self) -> None:
        """Check the ranges."""
        if not 0 < self.interval < np.inf:
            raise InputError(f"interval must be a positive time, got {self.interval}")
        if self.velocities < 1:
            raise InputError(f"a window needs a velocity at least, got {self.velocities}")

    @property
    def size(self) -> int:
        """Number of inputs."""
        return 1 + self.velocities


class Senses:
    """Collects observations, and makes inputs of them.

    With z the seen heights of the human's end and dt the window's interval, the inputs are

        z(-0), z(-0) - z(-dt), z(-dt) - z(-2 dt), ...

    with times from now, and z(-0) the newest that was seen, which is a latency old. Between two
    samples they are interpolated, before the first they are as with the first.

    It also tells the sag: how far the hand is below its command of :data:`ARM_LAG` ago, which is
    what the arm gives way under its load.
    """

    def __init__(self, window: Window) -> None:
        self._window = window
        self._keep = window.interval * (window.velocities + 1)
        self._times: list[float] = []
        self._heights: list[float] = []
        self._commands: list[float] = []
        self._sag = 0.0

    def see(self, observation: Observation) -> None:
        """Take the newest observation in."""
        time = float(observation[RobotObservation.TIME])
        while len(self._times) > 1 and self._times[1] < time - self._keep:
            for values in (self._times, self._heights, self._commands):
                del values[0]
        self._times.append(time)
        self._heights.append(float(observation[RobotObservation.HUMAN_END]))
        self._commands.append(float(observation[RobotObservation.HAND_COMMAND]))
        expected = float(np.interp(time - ARM_LAG, self._times, self._commands))
        self._sag = expected - float(observation[RobotObservation.HAND_HEIGHT])

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
        return self._sag

    def period(self, default: float) -> float:
        """Return the time between the last two observations [s]; the default before."""
        return self._times[-1] - self._times[-2] if len(self._times) > 1 else default

    def command(self, age: float) -> float:
        """Return the own command of that long ago [m]."""
        return float(np.interp(self._times[-1] - age, self._times, self._commands))

    def inputs(self) -> Array:
        """Return the inputs, shape ``(window.size,)`` [m]."""
        ages = self._window.interval * np.arange(self._window.size)
        heights = np.interp(self._times[-1] - ages, self._times, self._heights)
        return np.concatenate((heights[:1], heights[:-1] - heights[1:]))
