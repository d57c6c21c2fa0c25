"""Control by anticipation: forecast the human's motion, and plan commands by preview."""

import math
from collections import deque
from dataclasses import dataclass

import numpy as np
from colift.agents.agent import FRAME, Action, Observation, RobotObservation
from colift.agents.control.adaptive_impedance import certainty
from colift.agents.control.anticipation import (
    ARM_LAG,
    MODES,
    Anticipation,
    FeatureHistory,
    load_anticipation,
)
from colift.agents.control.preview import preview_gains
from colift.base.errors import InputError


@dataclass(frozen=True, kw_only=True)
class AnticipateParameters:
    """Parameters of :class:`Anticipate`."""

    model: str | None = None
    """File written by ``colift learn anticipate --out``; None: the shipped one."""
    horizon: float = 0.4
    """Time ahead over which commands are planned [s]."""
    smoothness: float = 0.1
    """Cost of a bend of the command, relative to a height difference of its size that lasts for a
    period (:func:`.preview_gains`)."""
    arm_lag: float = ARM_LAG
    """Assumed time by which the arm is behind its command [s]."""
    sag_memory: float = 0.1
    """Time constant of the filter of the arm's measured sag [s]."""
    memory: float = 0.5
    """Time constant of the squared forecast error [s]; only for the reported confidence."""
    tolerance: float = 0.005
    """Forecast error at which the confidence is one half [m]; only for the reported confidence."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If the smoothness or the lag is negative, or another number is not positive.
        """
        for name in ("smoothness", "arm_lag"):
            value = getattr(self, name)
            if not 0 <= value < math.inf:
                raise InputError(f"{name} must be a number of at least 0, got {value}")
        for name in ("horizon", "sag_memory", "memory", "tolerance"):
            value = getattr(self, name)
            if not 0 < value < math.inf:
                raise InputError(f"{name} must be a positive number, got {value}")


class AnticipationController:
    """The control law of :class:`Anticipate` with a given model.

    Parameters
    ----------
    model
        The learned forecast.
    parameters
        All other parameters; their ``model`` is ignored.
    """

    def __init__(self, model: Anticipation, parameters: AnticipateParameters) -> None:
        self._model, self._parameters = model, parameters
        self._internals: dict[str, float] = {}

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._history = FeatureHistory(self._model.window)
        self._sag = 0.0
        self._predictions: deque[tuple[float, float]] = deque()
        self._squared_error = 0.0

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        parameters, model, history = self._parameters, self._model, self._history
        history.add(observation)
        period = history.period(model.window.interval)
        frames = max(round(period / FRAME), 1)
        steps = max(round(parameters.horizon / period), 1)

        forecast = model.forecast(history.features())
        self._sag -= math.expm1(-period / parameters.sag_memory) * (history.sag - self._sag)
        times = FRAME * np.arange(1, steps * frames + 1)
        rises = np.interp(times + parameters.arm_lag, model.leads, forecast.rises)
        law = preview_gains(frames, steps, parameters.smoothness)
        command = float(observation[RobotObservation.HAND_COMMAND])
        path = history.height + self._sag + rises
        change = law(path, command, history.command(period)) - command

        self._compare(history.height, history.time - model.latency, period)
        end, before = np.interp((period, period - FRAME), model.leads, forecast.rises)
        self._predictions.append((history.time + period, history.height + end))
        led = float(law.path @ rises)
        whole = abs(led) + abs(change - led)
        self._internals = {
            "prediction": history.height + end,
            "predicted_velocity": (end - before) / FRAME,
            "predicted_end": history.height + forecast.stroke_rise,
            **dict(zip(MODES, forecast.modes.tolist(), strict=True)),
            "sag": self._sag,
            "confidence": certainty(self._squared_error, parameters.tolerance),
            "role": abs(led) / whole if whole else 0.0,
        }
        return np.array([change])

    def internals(self) -> dict[str, float]:
        """Return the quantities behind the last action.

        Prediction of the human's end at the end of the period [m], and its velocity there [m/s];
        ``predicted_end``, the height at which the stroke in progress ends [m]; the probabilities of
        rest, onset, stroke, pause and reversal (:data:`.MODES`); the compensated sag [m].
        Confidence t^2 / (t^2 + s^2), with s^2 the filtered squared error of the predictions and t
        the tolerance. Role, the fraction of the command's change that is due to the forecast: 0
        follows, 1 leads; the rest would also occur if the human stayed at the last seen height.
        """
        return self._internals

    def _compare(self, height: float, time: float, period: float) -> None:
        """Compare the newest sample with the prediction for its time."""
        while len(self._predictions) > 1 and self._predictions[1][0] <= time + FRAME / 2:
            self._predictions.popleft()
        if self._predictions and self._predictions[0][0] <= time + FRAME / 2:
            times, heights = np.array(self._predictions).T
            error = height - float(np.interp(time, times, heights))
            gain = -math.expm1(-period / self._parameters.memory)
            self._squared_error += gain * (error**2 - self._squared_error)


class Anticipate(AnticipationController):
    """Forecasts the human's next half second, and commands what keeps the table level (ours).

    Three parts; ``docs/background/anticipate.md`` shows the loss without each:

    **Forecast.** A small perceptron, learned in simulated lifts, maps the last two seconds of the
    human's end to the mean of its coming heights h(t). It replaces a mixture of several models: its
    training data hold onsets, pauses, reversals and irregular motion. It has no input from the
    robot: neither commands nor the sag of the hand add information to the human's end.

    **Arm.** The arm follows its command with a known lag, and sags under its load by an amount that
    varies along the stroke. The path to command is

        p(t) = h(t + ARM_LAG) + sag,

    with the sag measured by the hand's encoders and low-pass filtered. No parameter of the arm is
    learned.

    **Preview control.** The command is the first of the sequence that minimises the height
    difference over the coming periods, at a cost for bends (:func:`.preview_gains`). A command can
    only ramp within a period; the optimum therefore fits all ramps of the horizon to the whole
    path, instead of aiming at the human's height at the end of the period. The cost trades a level
    table for smooth motion.
    """

    def __init__(self, *, parameters: AnticipateParameters | None = None) -> None:
        parameters = parameters or AnticipateParameters()
        super().__init__(load_anticipation(parameters.model), parameters)
