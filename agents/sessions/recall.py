"""Recollection: the lifts before, as far as they fit, and a linear forecast for the rest."""

import math
from collections import deque
from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.anticipation import FeatureHistory
from colift.agents.control.linear_forecast import load_linear
from colift.agents.control.predictor import DEFAULT_PERIOD
from colift.agents.sessions.past_lifts import PastLifts
from colift.agents.sessions.sensor_age import SensorAge
from colift.base.errors import InputError


@dataclass(frozen=True, kw_only=True)
class RecallParameters:
    """Parameters of :class:`Recall`."""

    remember: bool = True
    """Whether lifts are remembered; without, only the forecast is left."""
    forgetting: float = 0.8
    """Share of the squared errors that is kept from step to step."""
    sag_memory: float = 0.1
    """Time constant of the filter of the arm's measured sag [s]."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If a number is out of range.
        """
        if not 0 <= self.forgetting < 1:
            raise InputError(f"forgetting must be at least 0 and below 1, got {self.forgetting}")
        if not 0 < self.sag_memory < math.inf:
            raise InputError(f"sag_memory must be a positive number, got {self.sag_memory}")


class Recall:
    """Goes where the person went after the same beginning in the lifts before (ours).

    Two predictions of the human's end at the end of the coming period are blended by the confidence

        C = s_f^2 / (s_f^2 + s_r^2):

    that of the lifts of the session so far (:class:`.PastLifts`), and that of
    :class:`.LinearForecast`, with the filtered squared errors s_r^2 and s_f^2 that they have made.
    The sag of the arm is added, as measured by its encoders. In the first lift with a person, the
    forecast is alone, and the samples are taken to be as old as usual (:class:`.SensorAge`).
    """

    def __init__(self, *, parameters: RecallParameters | None = None) -> None:
        self._parameters = parameters or RecallParameters()
        self._forecast = load_linear()
        self.begin_session()

    def begin_session(self) -> None:
        """Forget the last person."""
        self._past, self._age = PastLifts(), SensorAge()
        self._heights: list[float] = []

    def reset(self, seed: int) -> None:
        """Begin a lift; the last one is remembered."""
        if not self._parameters.remember:
            self.begin_session()
        self._past.add(self._heights)
        self._age.end_lift()
        self._heights = []
        self._history = FeatureHistory(self._forecast.window)
        self._made: deque[tuple[float, float, float]] = deque()
        self._errors = [1e-6, 1e-6]
        self._sag = 0.0

    def act(self, observation: Observation) -> Action:
        """Return the change [m] that brings the command to the predicted height."""
        parameters, history = self._parameters, self._history
        history.add(observation)
        period = history.period(DEFAULT_PERIOD)
        height, *changes = history.features()
        self._heights.append(float(height))
        self._age.add(observation)
        horizon = self._age.seconds + period
        forecast = self._forecast.rise(np.array(changes), horizon)
        past = self._past.recollect(self._heights, horizon / period, period)
        recalled = forecast if past is None else past.rise
        self._compare(float(height), round(horizon / period))
        self._made.append((float(height), forecast, recalled))
        of_forecast, of_past = self._errors
        if past is not None:
            of_past += past.spread**2
        confidence = 0.0 if past is None else of_forecast / (of_forecast + of_past)
        rise = forecast + confidence * (recalled - forecast)
        self._sag -= math.expm1(-period / parameters.sag_memory) * (history.sag - self._sag)
        self._internals = {
            "prediction": height + rise,
            "confidence": confidence,
            "role": confidence,
            "sag": self._sag,
        }
        wanted = height + rise + self._sag
        return np.array([wanted - observation[RobotObservation.HAND_COMMAND]])

    def internals(self) -> dict[str, float]:
        """Return prediction [m] and sag [m], and the confidence in the lifts before: the role."""
        return self._internals

    def _compare(self, height: float, steps: int) -> None:
        """Compare the newest sample with the predictions that were made for it."""
        if len(self._made) < steps:
            return
        then, *rises = self._made[-steps]
        kept = self._parameters.forgetting
        self._errors = [
            kept * error + (1.0 - kept) * (then + rise - height) ** 2 + 1e-8
            for error, rise in zip(self._errors, rises, strict=True)
        ]
