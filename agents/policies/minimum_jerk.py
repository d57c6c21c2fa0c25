"""A leader by the minimum-jerk model of the whole stroke."""

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from ..agent import Action, Observation, RobotObservation
from ..estimators.minimum_jerk_fit import (
    REFERENCE_PERIOD,
    MinimumJerkFit,
    MinimumJerkFitParameters,
)
from ..estimators.stroke_window import StrokeWindow, StrokeWindowParameters
from .predictor import DEFAULT_PERIOD


@dataclass(frozen=True, kw_only=True)
class MinimumJerkParameters:
    """Parameters of :class:`MinimumJerk`."""

    latency: float = 0.1
    """Assumed age of the seen heights [s]."""
    lag: float = 0.02
    """How far the hand is behind its command [s]: one cycle of the NAO's motion thread."""
    spread: float = 0.0007
    """Least standard deviation of a sample around the model [m]."""
    missed: float = 0.5
    """Share of the rms miss of the own forecasts by which the spread exceeds the least one."""
    forgetting: float = 0.45
    """Time in which a miss is forgotten to 1/e [s]."""
    fit: MinimumJerkFitParameters = field(default_factory=MinimumJerkFitParameters)
    """The fit of a stroke."""
    strokes: StrokeWindowParameters = field(default_factory=StrokeWindowParameters)
    """Where a stroke begins."""

    def __post_init__(self) -> None:
        """Check the ranges."""


class MinimumJerk:
    def __init__(self, *, parameters: MinimumJerkParameters | None = None) -> None:
        self._parameters = parameters or MinimumJerkParameters()

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._window = StrokeWindow(self._parameters.strokes)
        self._past: deque[tuple[float, Callable[[float], float]]] = deque()
        self._squares = self._count = 0.0
        self._time = None

    def act(self, observation: Observation) -> Action:
        p = self._parameters
        time = float(observation[RobotObservation.TIME])
        height = float(observation[RobotObservation.HUMAN_END])
        period = DEFAULT_PERIOD if self._time is None else time - self._time
        self._time = time
        # misses
        while len(self._past) > 1 and self._past[1][0] <= time - REFERENCE_PERIOD + 1e-6:
            self._past.popleft()
        if self._past:
            keep = math.exp(-period / p.forgetting)
            if self._past[0][0] <= time - REFERENCE_PERIOD + 1e-6:
                self._squares = keep * self._squares + period * (height - self._past[0][1](time)) ** 2
                self._count = keep * self._count + period
        self._window.add(time, height)
        ms = self._squares / self._count if self._count else 0.0
        spread = math.sqrt(p.spread**2 + p.missed**2 * ms)
        horizon = p.latency + period + p.lag
        if self._window.resting or len(self._window.times) < 3:
            rest = float(self._window.heights.mean())
            self._past.append((time, lambda _: rest))
            prediction, end, duration, role = rest, rest, 0.0, 0.0
        else:
            fit = MinimumJerkFit(self._window.times, self._window.heights, spread, p.fit)
            self._past.append((time, fit.height))
            prediction = fit.height(time + horizon)
            end, duration, role = fit.stroke.end, fit.stroke.duration, 1.0
        self._internals = {"prediction": prediction, "predicted_end": end, "predicted_duration": duration, "spread": spread, "role": role}
        return np.array([prediction - observation[RobotObservation.HAND_COMMAND]])

    def internals(self) -> dict[str, float]:
        return self._internals
