"""The robot's own hurdle: whether it is open, and the way to it."""

import math
from typing import Final

from colift.agents.agent import FRAME, Observation
from colift.agents.tasks.agree.observation import AgreeObservation

THERE: Final = 0.015
"""Distance within which an end counts as being at the hurdle [m]."""

STAY: Final = 0.2
"""Time for which the table has to be at the hurdle to have passed it [s]."""

SEEN_AGE: Final = 0.1
"""Age of the seen heights [s], as in the paper."""


class HurdleWatch:
    """The robot's own hurdle, as observed during an episode."""

    def __init__(self) -> None:
        self.height = self.start = self.stop = 0.0
        """Its height [m], and when its window opens and closes, from now [s]."""
        self.given = self.passed = False
        """Whether there is a hurdle, and whether both ends were seen to stay there in its
        window."""
        self._since: float | None = None

    def see(self, observation: Observation) -> None:
        """Take an observation, laid out as :class:`.AgreeObservation`."""
        layout = AgreeObservation
        self.height = float(observation[layout.HURDLE_HEIGHT])
        self.start = float(observation[layout.HURDLE_START])
        self.stop = float(observation[layout.HURDLE_STOP])
        self.given = bool(observation[layout.HURDLE_GIVEN] > 0.5)
        ends = (float(observation[layout.HUMAN_END]), float(observation[layout.ROBOT_END]))
        there = max(abs(end - self.height) for end in ends) < THERE
        time = float(observation[layout.TIME])
        if not (self.given and there and self.start <= -SEEN_AGE):
            self._since = None
        elif self._since is None:
            self._since = time
        elif time - self._since >= STAY - FRAME / 2:
            self.passed = True

    def is_open(self, early: float) -> bool:
        """Return whether it is time to go there, ``early`` [s] before the window opens or later."""
        return self.given and not self.passed and self.start < early and self.stop > 0.0


class Approach:
    """Moves a command to a height by the linear-quadratic regulator of a double integrator.

        x'' = w^2 (goal - x) - sqrt(2) w x'

    It begins with the present speed of the command.

    Parameters
    ----------
    pace
        w, the natural frequency [rad/s].
    """

    def __init__(self, pace: float) -> None:
        self._pace = pace
        self._last: tuple[float, float] | None = None

    def change(self, command: float, goal: float, time: float) -> float:
        """Return the change of the command in this period [m]; call it in each step.

        Parameters
        ----------
        command, goal
            The command now and the height to go to [m].
        time
            Time since the episode began [s].
        """
        before, since = self._last or (command, time - 10 * FRAME)
        self._last = command, time
        period = max(time - since, FRAME)
        speed, height, w = (command - before) / period, command, self._pace
        for _ in range(round(period / FRAME)):
            speed += (w * w * (goal - height) - math.sqrt(2.0) * w * speed) * FRAME
            height += speed * FRAME
        return height - command
