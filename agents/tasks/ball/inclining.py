"""Commands that incline the table as wanted, while the human moves the other end."""

import math
from typing import Final

import numpy as np
from colift.agents.agent import FRAME, Observation
from colift.agents.control.anticipation import ARM_LAG, FeatureHistory, load_anticipation
from colift.agents.control.preview import preview_gains
from colift.agents.tasks.ball.observation import BallObservation

HORIZON: Final = 0.4
"""Time ahead over which commands are planned [s]."""

SMOOTHNESS: Final = 0.1
"""Cost of a bend of the command, see :func:`.preview_gains`."""

SAG_MEMORY: Final = 0.1
"""Time constant of the filter of the arm's measured sag [s]."""


class Inclining:
    """Forecasts the height of the human's end, and commands a height difference from it.

    It is the controller of :class:`.Anticipate`, with a wanted difference added to the path.
    """

    def reset(self) -> None:
        """Begin an episode."""
        self._model = load_anticipation()
        self._history = FeatureHistory(self._model.window)
        self._sag = 0.0
        self._rises = np.zeros(len(self._model.leads))

    @property
    def period(self) -> float:
        """Time between the last two observations [s]."""
        return self._history.period(self._model.window.interval)

    @property
    def sag(self) -> float:
        """Height of the command above the robot's hand [m], filtered."""
        return self._sag

    def observe(self, observation: Observation) -> None:
        """Add the newest observation, and forecast the human's end."""
        history = self._history
        history.add(observation)
        self._rises = self._model.forecast(history.features()).rises
        self._sag -= math.expm1(-self.period / SAG_MEMORY) * (history.sag - self._sag)

    def height(self, times: float) -> float:
        """Return the height of the human's end [m] at a time from now on [s]."""
        return self._history.height + float(np.interp(times, self._model.leads, self._rises))

    def change(self, observation: Observation, difference: float) -> float:
        """Return the change of the command [m] for a height difference from now on [m]."""
        history, period = self._history, self.period
        frames = max(round(period / FRAME), 1)
        steps = max(round(HORIZON / period), 1)
        times = FRAME * np.arange(1, steps * frames + 1)
        rises = np.interp(times + ARM_LAG, self._model.leads, self._rises)
        law = preview_gains(frames, steps, SMOOTHNESS)
        command = float(observation[BallObservation.HAND_COMMAND])
        path = history.height + self._sag + rises + difference
        return law(path, command, history.command(period)) - command
