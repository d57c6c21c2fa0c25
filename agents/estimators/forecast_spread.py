"""The distance of samples from a model, estimated from the misses of its own forecasts."""

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from ..errors import InputError


@dataclass(frozen=True, kw_only=True)
class ForecastSpreadParameters:
    """Parameters of :class:`ForecastSpread`."""

    least: float = 0.0007
    """Least standard deviation of a sample around the model [m]: three times that of the motion
    capture."""
    share: float = 0.5
    """Share of the rms miss that is put down to the samples; the forecast has its own part."""
    forgetting: float = 0.45
    """Time in which the weight of a miss falls to 1/e [s]."""
    horizon: float = 0.1
    """Age at which a forecast is compared with a sample [s]."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If the share is negative, or another value is not a positive number.
        """
        if not 0 <= self.share < math.inf:
            raise InputError(f"share must be a number from 0 on, got {self.share}")
        for name in ("least", "forgetting", "horizon"):
            if not 0 < getattr(self, name) < math.inf:
                raise InputError(f"{name} must be a positive number, got {getattr(self, name)}")


class ForecastSpread:
    """Standard deviation of samples around the model that forecasts them.

    With the misses e_i = z_i - forecast(t_i) of forecasts as old as the horizon,

        spread^2 = least^2 + share^2 sum_i w_i e_i^2 / sum_i w_i,
        w_i = exp(-(t - t_i) / forgetting) (t_i - t_(i-1)).

    So a person who keeps to the model is trusted to the noise of the sensor, and one who does not
    is less so.
    """

    def __init__(self, parameters: ForecastSpreadParameters | None = None) -> None:
        self._parameters = parameters or ForecastSpreadParameters()
        self._past: deque[tuple[float, Callable[[float], float]]] = deque()
        self._squares = self._weight = 0.0

    def compare(self, time: float, height: float, period: float) -> None:
        """Compare a sample [m], taken ``period`` [s] after the last, with the forecast of it."""
        ripe = time - self._parameters.horizon + 1e-6
        while len(self._past) > 1 and self._past[1][0] <= ripe:
            self._past.popleft()
        if self._past and self._past[0][0] <= ripe:
            keep = math.exp(-period / self._parameters.forgetting)
            miss = height - self._past[0][1](time)
            self._squares = keep * self._squares + period * miss**2
            self._weight = keep * self._weight + period

    def remember(self, time: float, forecast: Callable[[float], float]) -> None:
        """Keep a forecast, a height [m] by the time [s], that was made at a time [s]."""
        self._past.append((time, forecast))

    @property
    def spread(self) -> float:
        """The standard deviation [m]."""
        mean_square = self._squares / self._weight if self._weight else 0.0
        return math.hypot(self._parameters.least, self._parameters.share * math.sqrt(mean_square))
