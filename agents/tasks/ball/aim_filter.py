"""A bank of Kalman filters for the aim that a person's wrists show."""

from typing import Final

import numpy as np
from colift.agents.tasks.ball.facts import PULL
from numpy.typing import NDArray

RATE: Final = 2.0
"""Assumed natural frequency with which people steer [rad/s]."""

DAMPING: Final = 0.8
"""Assumed damping ratio."""

PARTS: Final = np.geomspace(0.15, 1.1, 8)
"""Candidates for the part of the wanted inclination that the wrists show, equally likely before the
episode."""

FELT_NOISE: Final = 0.0084
"""Standard deviation of the height difference that the wrists seem to mean [m]."""

PLACE_NOISE: Final = 0.01
"""Standard deviation of the aim that people's delays add [m]."""

DRIFT: Final = 0.03
"""Standard deviation of the aim's change in a period of 0.1 s [m]."""

SPREAD: Final = 0.1
"""Standard deviation of the aim before the episode [m]."""


def wanted_difference(place: float, speed: float, aim: float) -> float:
    """Return the height difference [m] with which a person would bring the ball to an aim.

        d = (w^2 (s - y) + 2 z w v) / PULL

    The aim y of a moving target x is x + (2 z / w) x' + x'' / w^2.
    """
    return (RATE**2 * (place - aim) + 2 * DAMPING * RATE * speed) / PULL


class AimFilter:
    """Estimates the aim of a person whose wrists show an unknown part of what the person wants.

    If the wrists show the part k, they mean k d. Each candidate k therefore turns the felt c into a
    different measurement

        y = s + (2 z / w) v - PULL c / (k w^2)

    of an aim that drifts. Each candidate has its own Kalman filter and is weighted by the
    likelihood of its predictions (Bayes); the estimate is the weighted mean.

    Parameters
    ----------
    felt_noise
        Standard deviation of the height difference that the wrists seem to mean [m].
    """

    def __init__(self, felt_noise: float = FELT_NOISE) -> None:
        self._felt_noise = felt_noise

    def reset(self) -> None:
        """Begin an episode: the aim is near the middle."""
        self._aims = np.zeros(len(PARTS))
        self._variances = np.full(len(PARTS), SPREAD**2)
        self._evidence = np.zeros(len(PARTS))

    @property
    def weights(self) -> NDArray[np.float64]:
        """Probability of each of the candidates."""
        likely = np.exp(self._evidence - self._evidence.max())
        return np.asarray(likely / likely.sum())

    @property
    def aim(self) -> float:
        """The estimate [m]."""
        return float((self.weights * self._aims).sum())

    @property
    def part(self) -> float:
        """The expected part of the wanted inclination that the wrists show."""
        return float((self.weights * PARTS).sum())

    def update(self, place: float, speed: float, meant: float, period: float) -> None:
        """Add the height difference that the wrists mean [m], and the ball's place and speed."""
        scale = PULL / RATE**2 / PARTS
        seen = place + 2 * DAMPING / RATE * speed - scale * meant
        self._variances = self._variances + DRIFT**2 * max(period, 0.0) / 0.1
        total = self._variances + (scale * self._felt_noise) ** 2 + PLACE_NOISE**2
        error = seen - self._aims
        # The candidates compete to predict the felt difference, not the aim.
        self._evidence += -0.5 * error**2 / total - 0.5 * np.log(total / scale**2)
        gain = self._variances / total
        self._aims = self._aims + gain * error
        self._variances = (1 - gain) * self._variances
