"""A linear forecast of the human's end from its last ten samples."""

from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from typing import Any, Final

import numpy as np
from colift.agents.control.anticipation import FeatureWindow
from colift.agents.control.learned import learned_json, load_learned, read_learned
from colift.agents.control.portable import PORTABLE
from colift.base.errors import InputError
from numpy.typing import NDArray

Array = NDArray[np.float64]

TAPS: Final = 10
"""Samples from which the rise is forecast."""


@dataclass(frozen=True, kw_only=True, eq=False)
class LinearForecast:
    """The rise of the human's end above its newest sample as a linear function of past changes.

    With the sample z(t) and those before it, dt apart, the rise until a horizon H after it is

        z(t + H) - z(t) = sum_i w_i(H) (z(t - i dt) - z(t - (i + 1) dt)),  i = 0 ... TAPS - 2.

    The weights do not depend on the height at which the hand is. They are linear in H between the
    horizons at which they were fitted, and zero at H = 0.

    Raises
    ------
    InputError
        If the parts do not fit together, or a number is not finite.
    """

    interval: float
    """Time dt between the samples [s]."""
    horizons: Array
    """(m,) times H from the newest sample [s], positive and increasing."""
    weights: Array
    """(m, TAPS - 1) w at each of the horizons."""
    provenance: dict[str, Any] = field(default_factory=dict)
    """Training data and method."""

    def __post_init__(self) -> None:
        """Check that the parts fit together."""
        FeatureWindow(interval=self.interval)
        wanted = (len(self.horizons), TAPS - 1)
        if self.weights.shape != wanted or not np.isfinite(self.weights).all():
            raise InputError(
                f"{wanted[0]} horizons need finite weights of the shape {wanted}, got "
                f"{self.weights.shape}"
            )
        if not len(self.horizons) or not (np.diff(self.horizons, prepend=0.0) > 0).all():
            raise InputError(
                f"horizons must be positive and increase, got {self.horizons.tolist()}"
            )

    @property
    def window(self) -> FeatureWindow:
        """The past from which it forecasts."""
        return FeatureWindow(interval=self.interval, velocities=TAPS - 1)

    def rise(self, changes: Array, horizon: float) -> float:
        """Return the rise of the human's end until a horizon after the newest sample [m].

        Parameters
        ----------
        changes
            (TAPS - 1,) changes of the height, the latest first [m].
        horizon
            Time from the newest sample [s]; beyond the last of the horizons, it counts as that.
        """
        rises = PORTABLE.product(self.weights, changes)
        return float(np.interp(horizon, (0.0, *self.horizons), (0.0, *rises)))


def linear_json(forecast: LinearForecast) -> str:
    """Return the content of a file for :func:`read_linear`."""
    return learned_json(
        {
            "interval_s": forecast.interval,
            "horizons_s": forecast.horizons.tolist(),
            "weights": [[float(f"{w:.5g}") for w in row] for row in forecast.weights.tolist()],
            "provenance": forecast.provenance,
        }
    )


def read_linear(text: str) -> LinearForecast:
    """Return the forecast of :func:`linear_json`.

    Raises
    ------
    InputError
        As :func:`.read_learned`.
    """
    return read_learned(text, _from_parts, "a linear forecast")


@cache
def load_linear(path: str | None = None) -> LinearForecast:
    """Return the forecast of a file; without a path, the shipped one.

    Raises
    ------
    InputError
        As :func:`.load_learned`.
    """
    shipped = files(__package__).joinpath("data", "linear.json")
    return load_learned(path, shipped, read_linear)


def _from_parts(parts: Any) -> LinearForecast:
    return LinearForecast(
        interval=float(parts["interval_s"]),
        horizons=np.array(parts["horizons_s"], dtype=np.float64),
        weights=np.array(parts["weights"], dtype=np.float64),
        provenance=parts["provenance"],
    )
