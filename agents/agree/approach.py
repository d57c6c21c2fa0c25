"""The robot's way to its own hurdle."""

import math
from typing import Final

from ..agent import FRAME, Observation
from ..observations import AgreeObservation
from .turn import FAR_NEAR

ROBOT_PACE: Final = 7.0
"""Natural frequency of the approach [rad/s]."""


class Approach:
    """Moves a command to a height by the linear-quadratic regulator of a double integrator.

        x'' = w^2 (goal - x) - sqrt(2) w x'

    It begins with the speed that the command has.
    """

    def __init__(self, pace: float = ROBOT_PACE) -> None:
        self._pace = pace
        self._last: tuple[float, float] | None = None

    def change(self, command: float, goal: float, time: float) -> float:
        """Return the change of the command in this period [m].

        Parameters
        ----------
        command, goal
            The command now and the height to go to [m].
        time
            Time since the episode began [s].
        """
        before, since = self._last or (command, time - 0.1)
        self._last = command, time
        period = max(time - since, FRAME)
        speed, height, w = (command - before) / period, command, self._pace
        for _ in range(round(period / FRAME)):
            speed += (w * w * (goal - height) - math.sqrt(2.0) * w * speed) * FRAME
            height += speed * FRAME
        return height - command


class OwnHurdleState:
    """Whether the robot's hurdle is open, and whether the table has passed it."""

    def __init__(self) -> None:
        self.passed = False

    def see(self, observation: Observation) -> None:
        """Note whether both ends are seen at the hurdle in its window."""
        height = float(observation[AgreeObservation.VIA_HEIGHT])
        ends = observation[[AgreeObservation.HUMAN_END, AgreeObservation.ROBOT_END]].tolist()
        near = max(abs(end - height) for end in ends) < FAR_NEAR
        open_then = observation[AgreeObservation.VIA_START] <= -0.1
        given = observation[AgreeObservation.VIA_GIVEN] > 0.5
        self.passed = self.passed or bool(near and open_then and given)
