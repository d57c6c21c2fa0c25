"""A linear forecast that is fitted again to each person."""

from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.anticipation import FeatureHistory
from colift.agents.control.linear_forecast import TAPS, load_linear
from colift.agents.control.predictor import DEFAULT_PERIOD
from colift.agents.sessions.sensor_age import SensorAge
from colift.base.errors import InputError
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True)
class SessionLinearParameters:
    """Parameters of :class:`SessionLinear`."""

    remember: bool = True
    """Whether it learns from lift to lift; without, each lift is the first."""
    doubt: float = 30.0
    """Variance of the weights before the first lift, over that of the rises [1/m2]."""

    def __post_init__(self) -> None:
        """Check the range.

        Raises
        ------
        InputError
            If the doubt is negative or not finite.
        """
        if not 0 <= self.doubt < np.inf:
            raise InputError(f"doubt must be a number of at least 0, got {self.doubt}")


class SessionLinear:
    """Linear prediction as :class:`.Linear`, whose weights learn from each lift (ours).

    The weights begin as the shipped ones for the horizon H, the age of the samples
    (:class:`.SensorAge`) and a period. With the changes x before a sample and the rise y that
    followed, each sample of a lift that has ended improves them by recursive least squares,

        k = P x / (1 + x' P x),  w <- w + k (y - x' w),  P <- P - k x' P,

    with P = doubt I at first.
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
        weights, cov = self._first_weights(), self._parameters.doubt * np.eye(TAPS - 1)
        ahead = self._horizon / self._period
        for lift in self._lifts:
            heights = np.array([features[0] for features in lift])
            for step in range(len(lift) - int(np.ceil(ahead))):
                changes = lift[step][1:]
                rise = float(np.interp(step + ahead, np.arange(len(lift)), heights))
                spread = (cov * changes).sum(axis=1)
                gain = spread / (1.0 + float((changes * spread).sum()))
                error = rise - heights[step] - float((changes * weights).sum())
                weights = weights + gain * error
                cov = cov - gain[:, None] * spread
        self._weights = weights

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
