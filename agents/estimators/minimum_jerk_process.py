"""Stochastic process of a hand that moves by minimum jerk from any state."""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.estimators.minimum_jerk import Array
from colift.base.errors import InputError

# c4 and c5 of the quintic by v, a and j, and the powers of 1 / D that go with them.
_BRAKING: Final = np.array([[-1.0, -0.75, -0.25], [0.6, 0.4, 0.1]])
_POWERS: Final = np.array([[3.0, 2.0, 1.0], [4.0, 3.0, 2.0]])


def minimum_jerk_transition(period: float, time_to_go: float) -> Array:
    """Return the transition of (height, velocity, acceleration, jerk) over ``period`` [s], (4, 4).

    From any state, the minimum-jerk movement to rest after the time to go D is a quintic (Flash and
    Hogan 1985):

        z(t) = s + v t + a t^2 / 2 + j t^3 / 6 + c4 t^4 + c5 t^5,  z'(D) = z''(D) = 0
        c4 = -v / D^3 - 3 a / (4 D^2) - j / (4 D)
        c5 = 3 v / (5 D^4) + 2 a / (5 D^3) + j / (10 D^2)

    Valid for periods up to D.
    """
    t = period
    moved = np.array(
        [
            [1.0, t, t**2 / 2, t**3 / 6],
            [0.0, 1.0, t, t**2 / 2],
            [0.0, 0.0, 1.0, t],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )
    moved[:, 1:] += _last_two(t) @ (_BRAKING / time_to_go**_POWERS)
    return moved


@dataclass(frozen=True, kw_only=True)
class MinimumJerkProcess:
    """The motion of a hand to an unknown goal, as a process with five states.

    The state is height s, velocity v, acceleration a, jerk j, and a clock C that counts down to the
    end of the movement. The first four advance by :func:`minimum_jerk_transition` with the time to
    go D(C) of :meth:`time_to_go`; the clock decreases at the rate of time. Given D, the rates
    determine the end of the movement:

        goal = s + 3/5 v D + 3/20 a D^2 + 1/60 j D^3

    Noise enters the clock and, by a snap (its rate) that is constant in a step, the jerk.
    """

    jerk_noise: float = 1.0
    """Noise density of the jerk [m/s3/s^0.5]: people change their minds."""
    clock_noise: float = 0.1
    """Noise density of a person's own clock [s/s^0.5]."""
    shortest: float = 0.8
    """Least time to go [s]: near the goal, a person still makes corrections."""
    softness: float = 0.2
    """Width of the transition of the time to go to its least value [s]."""

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

    def time_to_go(self, clock: float) -> tuple[float, float]:
        """Return the time to go D [s] of a clock C [s], and dD/dC.

        D equals C while C is large, and levels off at the shortest D0 with the softness b:

            D = D0 + b log(1 + exp((C - D0) / b))
        """
        x = (clock - self.shortest) / self.softness
        bend = float(np.logaddexp(0.0, x))
        return self.shortest + self.softness * bend, math.exp(x - bend)

    def advance(self, state: Array, period: float) -> tuple[Array, Array]:
        """Return the state after ``period`` [s], shape (5,), and its Jacobian, shape (5, 5).

        Beyond the time to go, the hand rests.
        """
        left, slope = self.time_to_go(float(state[4]))
        t = min(period, left)
        by_rates = minimum_jerk_transition(t, left)
        jacobian = np.eye(5)
        jacobian[:4, :4] = by_rates
        by_left = -_BRAKING * _POWERS / left ** (_POWERS + 1)
        jacobian[:4, 4] = slope * (_last_two(t) @ by_left @ state[1:4])
        return np.append(by_rates @ state[:4], state[4] - period), jacobian

    def noise(self, period: float) -> Array:
        """Return the covariance Q of the process noise of a step of ``period`` [s], shape (5, 5).

        The variance of the snap is jerk_noise^2 / period; its effect over a given time does not
        depend on the period.
        """
        gain = np.array([period**4 / 24, period**3 / 6, period**2 / 2, period, 0.0])
        covariance = self.jerk_noise**2 / period * np.outer(gain, gain)
        covariance[4, 4] = self.clock_noise**2 * period
        return covariance

    def goal(self, state: Array) -> float:
        """Return the height at which the movement ends [m]."""
        left, _ = self.time_to_go(float(state[4]))
        return float(state[:4] @ [1.0, 0.6 * left, 0.15 * left**2, left**3 / 60])


def _last_two(t: float) -> Array:
    """Return t^4 and t^5 with their first three derivatives, shape (4, 2)."""
    return np.array(
        [[t**4, t**5], [4 * t**3, 5 * t**4], [12 * t**2, 20 * t**3], [24 * t, 60 * t**2]]
    )
