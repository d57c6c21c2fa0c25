"""The minimum-jerk stroke that fits samples best: nonlinear weighted least squares."""

import math
from typing import Final

import numpy as np

from .minimum_jerk import Array, MinimumJerkStroke, course

STEPS: Final = 30
"""Most steps of the search; ten are usual."""

TOLERANCE: Final = 1e-4
"""The search ends with a step that lowers the sum of squares by less than this share."""

SINGULAR: Final = 1e-15
"""What keeps the normal equations regular if onset and duration make no difference [m2]."""


class Samples:
    """Weighted samples of a stroke.

    Parameters
    ----------
    times
        (n,) when they were taken [s].
    heights
        (n,) what was seen [m].
    shares
        (n,) weight of each, summing up to 1.
    pull
        Weight of the prior that the rise is 0, positive. Without it, the first samples of a stroke
        could be those of one that goes on for many metres.
    """

    def __init__(self, times: Array, heights: Array, shares: Array, pull: float) -> None:
        self._times, self._heights, self._shares, self._pull = times, heights, shares, pull
        self._mean_height = float(shares @ heights)

    def search(
        self, onset: float, duration: float, limits: tuple[float, float]
    ) -> MinimumJerkStroke:
        """Return the stroke of the least misfit, by the method of Levenberg and Marquardt.

        Parameters
        ----------
        onset, duration
            Where to begin [s].
        limits
            Least and longest duration [s].
        """
        stroke = self.complete(onset, duration)
        misfit = self.misfit(stroke)
        damping = 1e-3
        for _ in range(STEPS):
            trial = self._step(stroke, damping, limits)
            missed = self.misfit(trial)
            damping *= 0.1 if missed < misfit else 10.0
            if missed < misfit:
                settled = missed > (1 - TOLERANCE) * misfit
                stroke, misfit = trial, missed
                if settled:
                    break
        return stroke

    def complete(self, onset: float, duration: float) -> MinimumJerkStroke:
        """Return the stroke of that onset and duration [s] whose start and end fit best.

        The height is linear in these two, so that they follow (variable projection; Golub and
        Pereyra, SIAM J. Numer. Anal. 10, 1973).
        """
        done = course((self._times - onset) / duration)
        mean_done = float(self._shares @ done)
        weighted = self._shares * (done - mean_done)
        rise = float(weighted @ self._heights) / (float(weighted @ done) + self._pull)
        start = self._mean_height - rise * mean_done
        return MinimumJerkStroke(start=start, end=start + rise, onset=onset, duration=duration)

    def misfit(self, stroke: MinimumJerkStroke) -> float:
        """Return the weighted mean squared miss [m2], and pull (end - start)^2."""
        missed = self._shares @ np.square(self._heights - stroke.height(self._times))
        return float(missed) + self._pull * (stroke.end - stroke.start) ** 2

    def _step(
        self, stroke: MinimumJerkStroke, damping: float, limits: tuple[float, float]
    ) -> MinimumJerkStroke:
        """Return the stroke after one damped Gauss-Newton step in onset and log duration."""
        gradient = stroke.gradient(self._times)
        gradient[3] *= stroke.duration
        rise = np.array([-1.0, 1.0, 0.0, 0.0])
        normal = (gradient * self._shares) @ gradient.T + self._pull * np.outer(rise, rise)
        normal[np.diag_indices(4)] *= 1 + damping
        normal[np.diag_indices(4)] += SINGULAR
        misses = self._heights - stroke.height(self._times)
        descent = (
            gradient @ (self._shares * misses) - self._pull * (stroke.end - stroke.start) * rise
        )
        _, _, later, longer = np.linalg.solve(normal, descent).tolist()
        duration = stroke.duration * math.exp(min(max(longer, -1.0), 1.0))
        return self.complete(stroke.onset + later, min(max(duration, limits[0]), limits[1]))
