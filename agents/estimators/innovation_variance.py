"""Adaptive innovation variance: deviation of samples from a model, by its own forecast errors."""

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from colift.base.errors import InputError


@dataclass(frozen=True, kw_only=True)
class InnovationVarianceParameters:
    """Parameters of :class:`InnovationVariance`."""

    floor: float = 0.0007
    """Least standard deviation of a sample around the model [m]: three times that of the motion
    capture."""
    fraction: float = 0.5
    """Fraction of the rms error that is attributed to the samples, not to the forecast."""
    memory: float = 0.45
    """Time in which the weight of an error falls to 1/e [s]."""
    horizon: float = 0.1
    """Age at which a forecast is compared with a sample [s]."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If the fraction is negative, or another value is not a positive number.
        """
        if not 0 <= self.fraction < math.inf:
            raise InputError(f"fraction must be a number of at least 0, got {self.fraction}")
        for name in ("floor", "memory", "horizon"):
            if not 0 < getattr(self, name) < math.inf:
                raise InputError(f"{name} must be a positive number, got {getattr(self, name)}")


class InnovationVariance:
    """Standard deviation of samples around the model that forecasts them.

    With the errors e_i = z_i - forecast(t_i) of forecasts as old as the horizon,

        deviation^2 = floor^2 + fraction^2 sum_i w_i e_i^2 / sum_i w_i,
        w_i = exp(-(t - t_i) / memory) (t_i - t_(i-1)).

    For a person who moves as modelled, the deviation falls to the sensor's noise.
    """

    def __init__(self, parameters: InnovationVarianceParameters | None = None) -> None:
        self._parameters = parameters or InnovationVarianceParameters()
        self._past: deque[tuple[float, Callable[[float], float]]] = deque()
        self._squares = self._weight = 0.0

    def compare(self, time: float, height: float, period: float) -> None:
        """Compare a sample [m], taken ``period`` [s] after the last, with the forecast of it."""
        ripe = time - self._parameters.horizon + 1e-6
        while len(self._past) > 1 and self._past[1][0] <= ripe:
            self._past.popleft()
        if self._past and self._past[0][0] <= ripe:
            keep = math.exp(-period / self._parameters.memory)
            error = height - self._past[0][1](time)
            self._squares = keep * self._squares + period * error**2
            self._weight = keep * self._weight + period

    def remember(self, time: float, forecast: Callable[[float], float]) -> None:
        """Keep a forecast (height [m] as a function of time [s]) made at ``time`` [s]."""
        self._past.append((time, forecast))

    @property
    def deviation(self) -> float:
        """The standard deviation [m]."""
        mean_square = self._squares / self._weight if self._weight else 0.0
        parameters = self._parameters
        return math.hypot(parameters.floor, parameters.fraction * math.sqrt(mean_square))
