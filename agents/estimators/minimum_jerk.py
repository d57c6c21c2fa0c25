"""The minimum-jerk movement from rest to rest, and its derivatives.

The movement of least mean squared jerk between two points is

    z(t) = start + (end - start) s(tau),  tau = (t - onset) / duration
    s(tau) = 10 tau^3 - 15 tau^4 + 6 tau^5 for 0 <= tau <= 1, 0 before and 1 after

(Flash and Hogan, "The coordination of arm movements: an experimentally confirmed mathematical
model", J. Neurosci. 5, 1985).
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def profile(tau: Any) -> Array:
    """Return s, the covered fraction of the displacement, in [0, 1], at relative times."""
    t = np.clip(tau, 0.0, 1.0)
    return np.asarray(t * t * t * (10.0 + t * (6.0 * t - 15.0)))


def profile_rate(tau: Any) -> Array:
    """Return ds/dtau = 30 tau^2 (1 - tau)^2: bell-shaped, with a maximum of 1.875 at tau = 1/2."""
    t = np.clip(tau, 0.0, 1.0)
    bell = t * (1.0 - t)
    return np.asarray(30.0 * bell * bell)


def profile_curvature(tau: Any) -> Array:
    """Return d2s/dtau2 = 60 tau (1 - tau) (1 - 2 tau)."""
    t = np.clip(tau, 0.0, 1.0)
    return np.asarray(60.0 * t * (1.0 - t) * (1.0 - 2.0 * t))


@dataclass(frozen=True, kw_only=True)
class MinimumJerkStroke:
    """One movement from rest to rest. Times [s] may be numbers or arrays."""

    start: float
    """Height before [m]."""
    end: float
    """Height after [m]."""
    onset: float
    """Start time [s]."""
    duration: float
    """Duration [s], positive."""

    def tau(self, time: Any) -> Array:
        """Return the relative time: 0 at the onset, 1 at the end, not clipped."""
        return np.asarray((time - self.onset) / self.duration)

    def height(self, time: Any) -> Array:
        """Return the height [m]."""
        return self.start + (self.end - self.start) * profile(self.tau(time))

    def velocity(self, time: Any) -> Array:
        """Return the velocity [m/s]."""
        return (self.end - self.start) / self.duration * profile_rate(self.tau(time))

    def acceleration(self, time: Any) -> Array:
        """Return the acceleration [m/s2]."""
        return (self.end - self.start) / self.duration**2 * profile_curvature(self.tau(time))

    def gradient(self, time: Any) -> Array:
        """Return the derivatives of the height by start, end, onset and duration.

        Shape ``(4,)`` for one time, ``(4, n)`` for n of them.
        """
        done = profile(self.tau(time))
        velocity = self.velocity(time)
        return np.stack((1.0 - done, done, -velocity, -velocity * self.tau(time)))
