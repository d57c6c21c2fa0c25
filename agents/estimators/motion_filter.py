"""The paper's Kalman filter of human motion: nearly constant acceleration (equations 2 to 5)."""

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple, get_args

import numpy as np
from colift.agents.calibration import CALIBRATION
from colift.base.errors import InputError
from numpy.typing import NDArray

Matrix = NDArray[np.float64]

NoiseForm = Literal["jerk", "acceleration"]


@dataclass(frozen=True, kw_only=True)
class MotionFilterParameters:
    """Parameters of :class:`MotionFilter`, in millimetres and seconds as in the paper."""

    measurement_noise: float = 0.7
    """R, the variance of a measured height [mm2]: 0.7, "the uncertainty in measurement" of the
    motion-capture system (section III.B). Read literally as a variance; as a standard deviation
    of 0.7 mm it would be 0.49."""

    process_noise: float = CALIBRATION.process_noise
    """q, the intensity of the process noise [mm2/s6] as a variance of the jerk over a step. The
    paper does not state Q; this value is calibrated (``colift calibrate``). Its root is about half
    of the rms jerk of a 0.2 m minimum-jerk lift in 2 s, 671 mm/s3."""

    noise_enters: NoiseForm = "jerk"
    """Form of Q: q g g' with g = [t3/6, t2/2, t] (a jerk that is constant over a step), or
    q t2 on the acceleration alone."""

    initial_deviation: tuple[float, float, float] = (0.7**0.5, 10.0, 100.0)
    """Standard deviations of height [mm], velocity [mm/s] and acceleration [mm/s2] at the start:
    the lift begins at rest."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If a noise is not a positive number, the deviations are not three positive numbers,
            or there is no such form of the process noise.
        """
        for name in ("measurement_noise", "process_noise"):
            noise = getattr(self, name)
            if not 0 < noise < math.inf:
                raise InputError(f"{name} must be a positive number, got {noise}")
        deviation = self.initial_deviation
        if len(deviation) != 3 or not all(0 < entry < math.inf for entry in deviation):
            raise InputError(f"initial_deviation must be three positive numbers, got {deviation}")
        if self.noise_enters not in get_args(NoiseForm):
            known = ", ".join(get_args(NoiseForm))
            raise InputError(f"noise_enters must be one of {known}, got {self.noise_enters!r}")


class Prediction(NamedTuple):
    """Expected sample, before it is measured."""

    height: float
    """Predicted height [m], eq. 5."""
    variance: float
    """Variance of the predicted height [mm2], the marginal of the state's covariance."""
    velocity: float
    """Predicted velocity [m/s]."""
    acceleration: float
    """Predicted acceleration [m/s2]."""


def transition(period: float) -> Matrix:
    """Return F of eq. 4 for a step of ``period`` [s]: constant acceleration, shape (3, 3)."""
    return np.array([[1.0, period, period**2 / 2], [0.0, 1.0, period], [0.0, 0.0, 1.0]])


def process_covariance(parameters: MotionFilterParameters, period: float) -> Matrix:
    """Return Q for a step of ``period`` [s], shape (3, 3), in powers of mm and s."""
    q = parameters.process_noise
    if parameters.noise_enters == "jerk":
        gain = np.array([period**3 / 6, period**2 / 2, period])
        return q * np.outer(gain, gain)
    return np.diag([0.0, 0.0, q * period**2])


class MotionFilter:
    """Estimates height, velocity and acceleration of the human's end from its samples.

    The state x = (s, v, a) follows eq. 4, the measurement is z = s + v with v ~ N(0, R) (eq. 3).
    Both are linear: the paper's extended Kalman filter reduces to a Kalman filter.
    """

    def __init__(self, parameters: MotionFilterParameters | None = None) -> None:
        self._parameters = parameters or MotionFilterParameters()

    def reset(self, height: float) -> None:
        """Begin at rest at a measured height [m].

        Raises
        ------
        ValueError
            If the height is not a finite number.
        """
        _require_finite("a measured height", height)
        deviation = np.array(self._parameters.initial_deviation)
        # filterpy imports scipy.stats, which is slow: not at the start of every command.
        from filterpy.kalman import ExtendedKalmanFilter

        self._filter = ExtendedKalmanFilter(dim_x=3, dim_z=1)
        self._filter.x = np.array([[1000 * height], [0.0], [0.0]])
        self._filter.P = np.diag(deviation**2)
        self._filter.R = np.array([[self._parameters.measurement_noise]])

    def update(self, height: float) -> None:
        """Correct the state by a measured height [m].

        Raises
        ------
        ValueError
            If the height is not a finite number.
        """
        _require_finite("a measured height", height)
        measured = np.array([[1000 * height]])
        self._filter.update(measured, HJacobian=_observe, Hx=_measure)

    def predict(self, period: float) -> Prediction:
        """Advance the state by ``period`` [s] and return the expected sample (eqs. 4, 5).

        Raises
        ------
        ValueError
            If the period is not a finite number.
        """
        _require_finite("a period", period)
        self._filter.F = transition(period)
        self._filter.Q = process_covariance(self._parameters, period)
        self._filter.predict()
        return _prediction(self._filter.x, self._filter.P)

    def ahead(self, period: float) -> Prediction:
        """Return the sample expected ``period`` [s] from now (eq. 5), without advancing the filter.

        Raises
        ------
        ValueError
            If the period is not a finite number.
        """
        _require_finite("a period", period)
        step = transition(period)
        covariance = step @ self._filter.P @ step.T + process_covariance(self._parameters, period)
        return _prediction(step @ self._filter.x, covariance)

    @property
    def state(self) -> Matrix:
        """The state (s, v, a) [m, m/s, m/s2], shape (3,)."""
        state: Matrix = self._filter.x[:, 0] / 1000
        return state


def _prediction(state: Matrix, covariance: Matrix) -> Prediction:
    height, velocity, acceleration = (state[:, 0] / 1000).tolist()
    return Prediction(height, float(covariance[0, 0]), velocity, acceleration)


_H = np.array([[1.0, 0.0, 0.0]])


def _require_finite(name: str, value: float) -> None:
    if not math.isfinite(value):
        raise ValueError(f"{name} must be finite, got {value}")


def _observe(state: Matrix) -> Matrix:
    """Return the Jacobian of the measurement."""
    return _H


def _measure(state: Matrix) -> Matrix:
    """Return the expected measurement of a state (eq. 3)."""
    measured: Matrix = _H @ state
    return measured
