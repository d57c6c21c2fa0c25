"""Linear prediction: the human's end from its last ten samples, by weights of least squares."""

from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.anticipation import FeatureHistory
from colift.agents.control.linear_forecast import load_linear
from colift.agents.control.predictor import DEFAULT_PERIOD
from colift.base.errors import InputError


@dataclass(frozen=True, kw_only=True)
class LinearParameters:
    """Parameters of :class:`Linear`."""

    model: str | None = None
    """File written by ``colift learn linear --out``; None: the shipped one."""
    latency: float = 0.1
    """Assumed age of the seen heights [s]."""

    def __post_init__(self) -> None:
        """Check the range.

        Raises
        ------
        InputError
            If the latency is negative or not finite.
        """
        if not 0 <= self.latency < np.inf:
            raise InputError(f"latency must be a number of at least 0, got {self.latency}")


class Linear:
    """Goes to the height of the human's end that a linear function of ten samples predicts (ours).

    The weights (:class:`.LinearForecast`) were fitted by least squares to lifts of the people whom
    the trainers learn from; the horizon is the end of the coming period, ``latency`` and a period
    after the newest sample. With two samples and given weights it would be :class:`.Extrapolate`.
    """

    def __init__(self, *, parameters: LinearParameters | None = None) -> None:
        self._parameters = parameters or LinearParameters()
        self._forecast = load_linear(self._parameters.model)

    def reset(self, seed: int) -> None:
        """Begin an episode without any samples."""
        self._history = FeatureHistory(self._forecast.window)

    def act(self, observation: Observation) -> Action:
        """Return the change [m] that brings the command to the predicted height."""
        self._history.add(observation)
        height, *changes = self._history.features()
        horizon = self._parameters.latency + self._history.period(DEFAULT_PERIOD)
        self._prediction = height + self._forecast.rise(np.array(changes), horizon)
        return np.array([self._prediction - observation[RobotObservation.HAND_COMMAND]])

    def internals(self) -> dict[str, float]:
        """Return the predicted height of the human's end [m]."""
        return {"prediction": self._prediction}
