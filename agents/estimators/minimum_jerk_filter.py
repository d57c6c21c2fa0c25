"""An extended Kalman filter of a hand on its way by minimum jerk, goal and duration unknown."""

import math
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from filterpy.kalman import ExtendedKalmanFilter

from ..errors import InputError
from .minimum_jerk import Array

REST_SPREAD: Final = (0.001, 0.01, 0.1)
"""Standard deviations of velocity [m/s], acceleration [m/s2] and jerk [m/s3] of a hand at rest."""

# c4 and c5 of the quintic by v, a and j, and the powers of 1 / D that go with them.
_BRAKING: Final = np.array([[-1.0, -0.75, -0.25], [0.6, 0.4, 0.1]])
_POWERS: Final = np.array([[3.0, 2.0, 1.0], [4.0, 3.0, 2.0]])


@dataclass(frozen=True, kw_only=True)
class MinimumJerkFilterParameters:
    """Parameters of :class:`MinimumJerkFilter`."""

    measurement_noise: float = 0.0008
    """Standard deviation of a measured height around the model [m]: that of the motion capture,
    0.23 mm, and what a person does otherwise."""
    jerk_noise: float = 0.2
    """Intensity of the jerk that the model does not know [m/s2/s^0.5]: the standard deviation of
    the acceleration that it adds up to in a second."""
    clock_noise: float = 0.1
    """Standard deviation by which a person's own clock goes astray in a second [s/s^0.5]."""
    duration: float = 2.0
    """Mean duration of a movement [s]."""
    duration_spread: float = 0.25
    """Standard deviation of the duration [s]."""
    way: float = 0.1
    """Standard deviation of the way that a new movement goes, up or down [m]."""
    shortest: float = 0.5
    """Least time to go [s]: who is nearly there still corrects the rest of the way."""
    softness: float = 0.2
    """Width of the bend with which the time to go ends at the least [s]."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If a value is not a positive number.
        """
        for name, value in vars(self).items():
            if not 0 < value < math.inf:
                raise InputError(f"{name} must be a positive number, got {value}")


class Outlook(NamedTuple):
    """What the filter expects of the hand."""

    height: float
    """[m]"""
    variance: float
    """Variance of the height [m2]."""
    velocity: float
    """[m/s]"""


def transition(period: float, time_to_go: float) -> Array:
    """Return what takes (height, velocity, acceleration, jerk) ``period`` [s] on, shape (4, 4).

    From any state, the least jerk brings the hand to rest after the time to go D along a quintic
    (Flash and Hogan 1985):

        z(t) = s + v t + a t^2 / 2 + j t^3 / 6 + c4 t^4 + c5 t^5,  z'(D) = z''(D) = 0

    The period must be no longer than the time to go.
    """
    t = period
    quintic = np.array(
        [
            [1.0, t, t**2 / 2, t**3 / 6],
            [0.0, 1.0, t, t**2 / 2],
            [0.0, 0.0, 1.0, t],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )
    quintic[:, 1:] += _last_two(t) @ (_BRAKING / time_to_go**_POWERS)
    return quintic


def _last_two(t: float) -> Array:
    """Return t^4 and t^5 with their first three derivatives, shape (4, 2)."""
    return np.array(
        [[t**4, t**5], [4 * t**3, 5 * t**4], [12 * t**2, 20 * t**3], [24 * t, 60 * t**2]]
    )


def time_to_go(clock: float, parameters: MinimumJerkFilterParameters) -> tuple[float, float]:
    """Return the time to go D [s] of a clock C [s] that runs down, and dD/dC.

    D is C while that is long, and bends to the shortest D0 with the softness b:

        D = D0 + b log(1 + exp((C - D0) / b))
    """
    x = (clock - parameters.shortest) / parameters.softness
    share = 1 / (1 + math.exp(-x)) if x > 0 else math.exp(x) / (1 + math.exp(x))
    bent = max(x, 0.0) + math.log1p(math.exp(-abs(x)))
    return parameters.shortest + parameters.softness * bent, share


def advance(
    state: Array, period: float, parameters: MinimumJerkFilterParameters
) -> tuple[Array, Array]:
    """Return the state after ``period`` [s], shape (5,), and its Jacobian, shape (5, 5)."""
    left, slope = time_to_go(float(state[4]), parameters)
    t = min(period, left)
    by_rates = transition(t, left)
    by_time = -_last_two(t) @ (_BRAKING * _POWERS / left ** (_POWERS + 1)) @ state[1:4]
    jacobian = np.eye(5)
    jacobian[:4, :4] = by_rates
    jacobian[:4, 4] = by_time * slope
    return np.append(by_rates @ state[:4], state[4] - period), jacobian


def process_covariance(parameters: MinimumJerkFilterParameters, period: float) -> Array:
    """Return Q for a step of ``period`` [s], shape (5, 5): an unknown jerk, constant in the step.

    Its variance is intensity^2 / period, so that what it does does not depend on the period.
    """
    gain = np.array([period**3 / 6, period**2 / 2, period, 0.0, 0.0])
    covariance = parameters.jerk_noise**2 / period * np.outer(gain, gain)
    covariance[4, 4] = parameters.clock_noise**2 * period
    return covariance


class MinimumJerkFilter:
    """Tracks a hand that goes by minimum jerk to a goal it keeps to itself.

    The state is height s, velocity v, acceleration a, jerk j, and a clock C that runs down to the
    end of the movement. Given the time to go D(C), the rates say where it ends (:meth:`goal`):

        goal = s + 3/5 v D + 3/20 a D^2 + 1/60 j D^3

    The measurement is the height. So the state's own rates are linear in it, and of all
    parameters of the movement the time to go alone makes the model nonlinear, in its fourth and
    fifth derivative. Start, amplitude, onset and duration as a state would be strongly nonlinear
    while the hand has not gone far; an extended Kalman filter in these is far too sure of itself
    (mean NEES beyond 100 where 4 is right). This one is consistent from the first sample on.

    Lengths are in metres, unlike in :class:`.MotionFilter`.
    """

    def __init__(self, parameters: MinimumJerkFilterParameters | None = None) -> None:
        self._parameters = parameters or MinimumJerkFilterParameters()

    def reset(self, height: float) -> None:
        """Begin at rest at a measured height [m].

        Raises
        ------
        ValueError
            If the height is not a finite number.
        """
        _require_finite("a measured height", height)
        given = self._parameters
        self._filter = ExtendedKalmanFilter(dim_x=5, dim_z=1)
        self._filter.x = np.array([[height], [0.0], [0.0], [0.0], [given.shortest]])
        spread = np.array([given.measurement_noise, *REST_SPREAD, given.duration_spread])
        self._filter.P = np.diag(spread**2)
        self._filter.R = np.array([[given.measurement_noise**2]])

    def begin(self) -> None:
        """Take it that a new movement begins: goal and duration become those of the prior.

        Height, velocity and acceleration stay what they are. The goal is normal around the place
        where the hand would come to rest without any jerk now.
        """
        given = self._parameters
        x, covariance = self.state, self._filter.P
        left, slope = time_to_go(given.duration, given)
        prior = np.zeros((5, 5))
        prior[:3, :3] = covariance[:3, :3]
        prior[3, 3], prior[4, 4] = given.way**2, given.duration_spread**2
        # From (s, v, a, way, C) to (s, v, a, j, C): j = 60 way/D^3 - 36 v/D^2 - 9 a/D.
        change = np.eye(5)
        change[3] = [0.0, -36 / left**2, -9 / left, 60 / left**3, 0.0]
        change[3, 4] = -(36 * x[1] / left**3 + 18 * x[2] / left**2) * slope
        self._filter.x[3:, 0] = 0.0, given.duration
        self._filter.P = change @ prior @ change.T

    def predict(self, period: float) -> Outlook:
        """Advance the state by ``period`` [s] and return what is expected then.

        Raises
        ------
        ValueError
            If the period is not a positive number.
        """
        _require_positive("a period", period)
        moved, jacobian = advance(self.state, period, self._parameters)
        self._filter.F = jacobian
        self._filter.Q = process_covariance(self._parameters, period)
        self._filter.predict()
        # filterpy moves the state by F, which is right for the covariance only.
        self._filter.x = moved[:, None]
        return _outlook(moved, self._filter.P)

    def surprise(self, height: float) -> float:
        """Return how far a measured height [m] is from the expected one, in standard deviations."""
        variance = self._filter.P[0, 0] + self._parameters.measurement_noise**2
        return abs(height - float(self._filter.x[0, 0])) / math.sqrt(variance)

    def update(self, height: float) -> None:
        """Correct the state by a measured height [m].

        Raises
        ------
        ValueError
            If the height is not a finite number.
        """
        _require_finite("a measured height", height)
        self._filter.update(np.array([[height]]), HJacobian=_observe, Hx=_measure)

    def ahead(self, period: float) -> Outlook:
        """Return what is expected ``period`` [s] from now; the state stays as it is.

        Raises
        ------
        ValueError
            If the period is not a positive number.
        """
        _require_positive("a period", period)
        moved, jacobian = advance(self.state, period, self._parameters)
        noise = process_covariance(self._parameters, period)
        return _outlook(moved, jacobian @ self._filter.P @ jacobian.T + noise)

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

    @property
    def remaining(self) -> float:
        """The time to go [s]."""
        return time_to_go(float(self._filter.x[4, 0]), self._parameters)[0]

    @property
    def goal(self) -> float:
        """Where the movement ends [m]."""
        height, velocity, acceleration, jerk, _ = self.state.tolist()
        left = self.remaining
        return float(
            height + left * (0.6 * velocity + left * (0.15 * acceleration + left * jerk / 60))
        )


def _outlook(state: Array, covariance: Array) -> Outlook:
    return Outlook(float(state[0]), float(covariance[0, 0]), float(state[1]))


def _require_finite(name: str, value: float) -> None:
    if not math.isfinite(value):
        raise ValueError(f"{name} must be finite, got {value}")


def _require_positive(name: str, value: float) -> None:
    if not 0 < value < math.inf:
        raise ValueError(f"{name} must be a positive number, got {value}")


_H: Final = np.array([[1.0, 0.0, 0.0, 0.0, 0.0]])


def _observe(state: Array) -> Array:
    """Return the Jacobian of the measurement."""
    return _H


def _measure(state: Array) -> Array:
    """Return the measurement that a state gives."""
    measured: Array = _H @ state
    return measured
