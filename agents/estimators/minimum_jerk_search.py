"""Nonlinear weighted least-squares fit of a minimum-jerk stroke."""

import math
from typing import Final

import numpy as np
from colift.agents.estimators.minimum_jerk import Array, MinimumJerkStroke, profile

STEPS: Final = 30
"""Largest number of steps of the search; ten are usual."""

TOLERANCE: Final = 1e-4
"""The search ends with a step that lowers the sum of squares by less than this fraction."""

SINGULAR: Final = 1e-15
"""Keeps the normal equations regular where onset and duration have no effect [m2]."""


class Samples:
    """Weighted samples of a stroke.

    Parameters
    ----------
    times
        (n,) sample times [s].
    heights
        (n,) seen heights [m].
    weights
        (n,) weight of each, with sum 1.
    pull
        Weight of the prior that the rise is 0, positive. Without it, the first samples of a stroke
        would be compatible with a rise of many metres.
    """

    def __init__(self, times: Array, heights: Array, weights: Array, pull: float) -> None:
        self._times, self._heights, self._weights, self._pull = times, heights, weights, pull
        self._mean_height = float(weights @ heights)

    def search(
        self, onset: float, duration: float, limits: tuple[float, float]
    ) -> MinimumJerkStroke:
        """Return the stroke of least misfit, by the Levenberg-Marquardt method.

        Parameters
        ----------
        onset, duration
            Initial values [s].
        limits
            Least and longest duration [s].
        """
        stroke = self.complete(onset, duration)
        misfit = self.misfit(stroke)
        damping = 1e-3
        for _ in range(STEPS):
            trial = self._step(stroke, damping, limits)
            trial_misfit = self.misfit(trial)
            damping *= 0.1 if trial_misfit < misfit else 10.0
            if trial_misfit < misfit:
                settled = trial_misfit > (1 - TOLERANCE) * misfit
                stroke, misfit = trial, trial_misfit
                if settled:
                    break
        return stroke

    def complete(self, onset: float, duration: float) -> MinimumJerkStroke:
        """Return the stroke of that onset and duration [s] whose start and end fit best.

        The height is linear in these two: variable projection (Golub and Pereyra, SIAM J. Numer.
        Anal. 10, 1973).
        """
        done = profile((self._times - onset) / duration)
        mean_done = float(self._weights @ done)
        weighted = self._weights * (done - mean_done)
        rise = float(weighted @ self._heights) / (float(weighted @ done) + self._pull)
        start = self._mean_height - rise * mean_done
        return MinimumJerkStroke(start=start, end=start + rise, onset=onset, duration=duration)

    def misfit(self, stroke: MinimumJerkStroke) -> float:
        """Return the weighted mean squared error plus pull (end - start)^2 [m2]."""
        mean_square = self._weights @ np.square(self._heights - stroke.height(self._times))
        return float(mean_square) + self._pull * (stroke.end - stroke.start) ** 2

    def _step(
        self, stroke: MinimumJerkStroke, damping: float, limits: tuple[float, float]
    ) -> MinimumJerkStroke:
        """Return the stroke after one damped Gauss-Newton step in onset and log duration."""
        gradient = stroke.gradient(self._times)
        gradient[3] *= stroke.duration
        rise = np.array([-1.0, 1.0, 0.0, 0.0])
        normal = (gradient * self._weights) @ gradient.T + self._pull * np.outer(rise, rise)
        normal[np.diag_indices(4)] *= 1 + damping
        normal[np.diag_indices(4)] += SINGULAR
        errors = self._heights - stroke.height(self._times)
        descent = (
            gradient @ (self._weights * errors) - self._pull * (stroke.end - stroke.start) * rise
        )
        _, _, later, longer = np.linalg.solve(normal, descent).tolist()
        duration = stroke.duration * math.exp(min(max(longer, -1.0), 1.0))
        return self.complete(stroke.onset + later, min(max(duration, limits[0]), limits[1]))
