"""Extended Kalman filter of a minimum-jerk movement with unknown goal and duration."""

import math
from dataclasses import dataclass, field
from typing import Final

import numpy as np
from colift.agents.estimators.minimum_jerk import Array
from colift.agents.estimators.minimum_jerk_process import MinimumJerkProcess
from colift.base.errors import InputError

REST_DEVIATIONS: Final = (0.001, 0.01)
"""Standard deviations of velocity [m/s] and acceleration [m/s2] of a hand at rest."""


@dataclass(frozen=True, kw_only=True)
class MinimumJerkFilterParameters:
    """Parameters of :class:`MinimumJerkFilter`."""

    measurement_noise: float = 0.0012
    """Standard deviation of a measured height around the model [m]: motion capture (0.23 mm) and
    the person's deviation from the model."""
    duration: float = 2.0
    """Mean duration of a movement [s]."""
    duration_deviation: float = 0.2
    """Standard deviation of the duration [s]."""
    displacement: float = 0.1
    """Standard deviation of the displacement of a new movement, up or down [m]."""
    process: MinimumJerkProcess = field(default_factory=MinimumJerkProcess)
    """Process model of the hand."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If a value is not a positive number.
        """
        for name in ("measurement_noise", "duration", "duration_deviation", "displacement"):
            if not 0 < getattr(self, name) < math.inf:
                raise InputError(f"{name} must be a positive number, got {getattr(self, name)}")


class MinimumJerkFilter:
    """Estimates the states of :class:`.MinimumJerkProcess` from a hand's heights.

    The process is linear except in the time to go, which enters only with the fourth and fifth
    power of the step. With start, end, onset and duration as the state, the model would be strongly
    nonlinear early in a movement, and an extended Kalman filter overconfident; this one is
    consistent from the first sample on.
    """

    def __init__(self, parameters: MinimumJerkFilterParameters | None = None) -> None:
        self._parameters = parameters or MinimumJerkFilterParameters()
        self._process = self._parameters.process

    def reset(self, height: float) -> None:
        """Begin at rest at a height [m], just before a movement.

        Its goal is normally distributed around the height; the standard deviation of the jerk is
        60 displacement / D^3.

        Raises
        ------
        ValueError
            If the height is not a finite number.
        """
        _require_finite(height)
        given = self._parameters
        left, _ = given.process.time_to_go(given.duration)
        jerk = 60 * given.displacement / left**3
        rates = (*REST_DEVIATIONS, jerk)
        deviations = np.array([given.measurement_noise, *rates, given.duration_deviation])
        # filterpy imports scipy.stats, which is slow: not at the start of every command.
        from filterpy.kalman import ExtendedKalmanFilter

        self._filter = ExtendedKalmanFilter(dim_x=5, dim_z=1)
        self._filter.x = np.array([[height], [0.0], [0.0], [0.0], [given.duration]])
        self._filter.P = np.diag(deviations**2)
        self._filter.R = np.array([[given.measurement_noise**2]])

    def predict(self, period: float) -> None:
        """Advance the state by ``period`` [s].

        Raises
        ------
        ValueError
            If the period is not a positive number.
        """
        _require_positive(period)
        moved, self._filter.F = self._process.advance(self.state, period)
        self._filter.Q = self._process.noise(period)
        self._filter.predict()
        # filterpy advances the state by F, which is right for the covariance only.
        self._filter.x = moved[:, None]

    def update(self, height: float) -> None:
        """Correct the state by a measured height [m].

        Raises
        ------
        ValueError
            If the height is not a finite number.
        """
        _require_finite(height)
        self._filter.update(np.array([[height]]), HJacobian=_observe, Hx=_measure)

    def ahead(self, period: float) -> Array:
        """Return the state expected ``period`` [s] from now, without advancing the filter.

        Raises
        ------
        ValueError
            If the period is not a positive number.
        """
        _require_positive(period)
        return self._process.advance(self.state, period)[0]

    @property
    def state(self) -> Array:
        """The state (s, v, a, j, C) [m, m/s, m/s2, m/s3, s], shape (5,)."""
        state: Array = self._filter.x[:, 0].copy()
        return state

    @property
    def covariance(self) -> Array:
        """The covariance of the state, shape (5, 5)."""
        covariance: Array = self._filter.P.copy()
        return covariance


def _require_finite(height: float) -> None:
    if not math.isfinite(height):
        raise ValueError(f"a measured height must be finite, got {height}")


def _require_positive(period: float) -> None:
    if not 0 < period < math.inf:
        raise ValueError(f"a period must be a positive number, got {period}")


_H: Final = np.array([[1.0, 0.0, 0.0, 0.0, 0.0]])


def _observe(state: Array) -> Array:
    """Return the Jacobian of the measurement."""
    return _H


def _measure(state: Array) -> Array:
    """Return the expected measurement of a state."""
    measured: Array = _H @ state
    return measured
