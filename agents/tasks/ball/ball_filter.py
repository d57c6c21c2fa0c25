"""A Kalman filter for the place and the speed of the ball."""

from typing import Final

import numpy as np
from colift.agents.tasks.ball.facts import PULL
from numpy.typing import NDArray

PLACE_NOISE: Final = 0.00023
"""Standard deviation of a seen place [m]."""

PUSH_NOISE: Final = 0.15
"""Standard deviation of the ball's acceleration that the seen height difference does not explain,
[m/s2] over one period."""


class BallFilter:
    """A Kalman filter for the ball's place and speed at the time of the newest sample.

    The state x = (s, v) moves in a period T by

        s <- s + T v + T^2 u / 2,    v <- v + T u,    u = -PULL d,

    with d the height difference of the ends, far above near, averaged over the period.
    """

    def reset(self) -> None:
        """Begin an episode with the ball at rest in the middle."""
        self.place = self.speed = 0.0
        self._covariance: NDArray[np.float64] = np.diag((1e-6, 1e-4))

    def update(self, place: float, difference: float, period: float) -> None:
        """Add a seen place [m], a period after the last, and the mean difference since then [m]."""
        push = -PULL * difference
        self.place += period * self.speed + period**2 / 2 * push
        self.speed += period * push
        (a, b), (_, c) = self._covariance.tolist()
        g, h = period**2 / 2 * PUSH_NOISE, period * PUSH_NOISE
        a, b, c = a + 2 * period * b + period**2 * c + g * g, b + period * c + g * h, c + h * h
        total = a + PLACE_NOISE**2
        first, second = a / total, b / total
        error = place - self.place
        self.place += first * error
        self.speed += second * error
        self._covariance = np.array(
            (((1 - first) * a, (1 - first) * b), ((1 - first) * b, c - second * b))
        )

    def ahead(self, differences: list[float], step: float) -> tuple[float, float]:
        """Return place and speed after one step [s] for each of the height differences [m]."""
        place, speed = self.place, self.speed
        for difference in differences:
            push = -PULL * difference
            place += step * speed + step**2 / 2 * push
            speed += step * push
        return place, speed
