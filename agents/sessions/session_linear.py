"""A linear forecast that is fitted again to each person."""

from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.anticipation import FeatureHistory
from colift.agents.control.linear_forecast import TAPS, load_linear
from colift.agents.control.predictor import DEFAULT_PERIOD
from colift.agents.sessions.refitting import LeastSquares, RefittingParameters
from colift.agents.sessions.sensor_age import SensorAge
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True)
class SessionLinearParameters(RefittingParameters):
    """Parameters of :class:`SessionLinear`."""

    doubt: float = 30.0
    """Variance of the weights before the first lift, over that of the rises [1/m2]."""


class SessionLinear:
    """Linear prediction as :class:`.Linear`, whose weights learn from each lift (ours).

    The weights begin as the shipped ones for the horizon H, the age of the samples
    (:class:`.SensorAge`) and a period. The changes before each sample of a lift that has ended, and
    the rise that followed, improve them (:class:`.LeastSquares`).
    """

    def __init__(self, *, parameters: SessionLinearParameters | None = None) -> None:
        self._parameters = parameters or SessionLinearParameters()
        self._forecast = load_linear()
        self.begin_session()

    def begin_session(self) -> None:
        """Begin with a new person."""
        self._age = SensorAge()
        self._period = DEFAULT_PERIOD
        self._lifts: list[list[NDArray[np.float64]]] = []
        self._features: list[NDArray[np.float64]] = []
        self._weights = self._first_weights()

    def _first_weights(self) -> NDArray[np.float64]:
        horizon = self._horizon
        each = np.eye(TAPS - 1)
        return np.array([self._forecast.rise(one, horizon) for one in each])

    @property
    def _horizon(self) -> float:
        return self._age.seconds + self._period

    def reset(self, seed: int) -> None:
        """Begin a lift; the weights have learned from those before."""
        if not self._parameters.remember:
            self.begin_session()
        self._age.end_lift()
        if len(self._features) > TAPS:
            self._lifts.append(self._features)
            self._fit()
        self._features = []
        self._history = FeatureHistory(self._forecast.window)

    def _fit(self) -> None:
        """Fit the weights to all lifts, for the present horizon."""
        fitted = LeastSquares(self._first_weights(), self._parameters.doubt)
        ahead = self._horizon / self._period
        for lift in self._lifts:
            heights = np.array([features[0] for features in lift])
            for step in range(len(lift) - int(np.ceil(ahead))):
                changes = lift[step][1:]
                rise = float(np.interp(step + ahead, np.arange(len(lift)), heights))
                fitted.add(changes, rise - heights[step])
        self._weights = fitted.weights

    def act(self, observation: Observation) -> Action:
        """Return the change [m] that brings the command to the predicted height."""
        self._history.add(observation)
        self._age.add(observation)
        self._period = self._history.period(DEFAULT_PERIOD)
        features = self._history.features()
        self._features.append(features)
        self._prediction = float(features[0] + (features[1:] * self._weights).sum())
        return np.array([self._prediction - observation[RobotObservation.HAND_COMMAND]])

    def internals(self) -> dict[str, float]:
        """Return the predicted height of the human's end [m]."""
        return {"prediction": self._prediction}
