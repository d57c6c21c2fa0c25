"""What the samples of a stroke so far say of the whole: a fit of the minimum-jerk movement."""

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Final

import numpy as np

from ..errors import InputError
from .minimum_jerk import Array, MinimumJerkStroke, course

REFERENCE_PERIOD: Final = 0.1
"""Spacing of the samples [s] to which the spread of :class:`MinimumJerkFit` refers."""

SPAN: Final = 5.0
"""A sample older than this many memories has next to no weight (e^-5 = 0.7 %) and is left out."""

STEPS: Final = 30
"""Most steps of the least-squares search; ten are usual."""

TOLERANCE: Final = 1e-4
"""The search ends with a step that lowers the sum of squares by less than this share."""

NEGLIGIBLE: Final = 1e-7
"""Misfit [m, rms] that no search could lower: far below any sensor's."""


@dataclass(frozen=True, kw_only=True)
class MinimumJerkFitParameters:
    """Parameters of :class:`MinimumJerkFit`."""

    durations: tuple[float, float] = (0.6, 4.5)
    """Shortest and longest stroke that is thought of [s]."""
    elapsed: tuple[float, float] = (0.02, 1.5)
    """Least and most of a stroke that may have gone by at the newest sample, in durations; beyond
    1 it has ended."""
    rise: float = 0.3
    """Standard deviation of how far a stroke goes, up or down [m]: the reach of the robot's
    arms."""
    memory: float = 0.25
    """Time in which the weight of a sample falls to 1/e [s]: people keep to the model for a while,
    not for a whole stroke."""
    grid: tuple[int, int] = (12, 30)
    """Number of durations, and of elapsed shares, that are compared."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If a range is empty or not positive, a number is not positive, or the grid is smaller
            than 2 x 2.
        """
        for name in ("durations", "elapsed"):
            low, high = getattr(self, name)
            if not 0 < low < high < math.inf:
                raise InputError(f"{name} must be two increasing positive numbers, got {low, high}")
        for name in ("rise", "memory"):
            if not 0 < getattr(self, name) < math.inf:
                raise InputError(f"{name} must be a positive number, got {getattr(self, name)}")
        if min(self.grid) < 2:
            raise InputError(f"grid must be at least 2 x 2, got {self.grid}")


class MinimumJerkFit:
    """The minimum-jerk strokes that the samples so far may be the beginning of.

    A stroke is linear in its start and end once onset and duration are given, so that these two
    alone are searched and the others follow (variable projection; Golub and Pereyra, SIAM J.
    Numer. Anal. 10, 1973). On a grid of durations and of shares gone by, the likelihood of a stroke
    is

        p ~ exp(-1/2 sum_i w_i (z_i - z(t_i))^2 / spread^2),
        w_i = exp(-(t_n - t_i) / memory) (t_i - t_(i-1)) / 0.1 s

    with start and end integrated out: by a flat prior on the start and on the grid, and a normal
    one of mean 0 on the rise. Samples at a higher rate weigh less each, since what a person does
    otherwise than the model lasts longer than a sample.

    Early in a stroke many durations fit alike, and the best one is a gamble. So :attr:`stroke` is
    the best, but :meth:`height` is the mean over all, each as far as it is likely.

    Parameters
    ----------
    times
        (n,) when the samples were taken [s], increasing, n at least 3.
    heights
        (n,) what was seen [m]; the first few from the rest before the stroke, if there was one.
    spread
        Standard deviation of a sample around the model [m]: the sensor's noise, and what the
        person does otherwise.

    Raises
    ------
    ValueError
        If there are fewer than 3 samples, or not one height for each time.
    """

    def __init__(
        self,
        times: Array,
        heights: Array,
        spread: float,
        parameters: MinimumJerkFitParameters | None = None,
    ) -> None:
        parameters = parameters or MinimumJerkFitParameters()
        if len(times) < 3 or len(times) != len(heights):
            raise ValueError(
                f"a fit needs 3 samples or more, got {len(times)} times, {len(heights)} heights"
            )
        old = int(np.searchsorted(times, times[-1] - SPAN * parameters.memory))
        first = min(old, len(times) - 3)
        spacing = np.diff(times, prepend=2 * times[0] - times[1])[first:]
        self._times, self._heights = times[first:], heights[first:]
        self._now = float(times[-1])
        weights = np.exp((self._times - self._now) / parameters.memory) * spacing
        self._weight = float(weights.sum()) / REFERENCE_PERIOD
        self._shares = weights / weights.sum()
        self._limits = parameters.durations
        self._durations, self._elapsed = _grid(parameters)
        self._compare(spread, parameters.rise)

    def _compare(self, spread: float, rise: float) -> None:
        """Find the best rise and the probability of each stroke of the grid."""
        ages = self._now - self._times
        done = course(self._elapsed[:, None] - ages / self._durations[:, None])
        self._mean_done = done @ self._shares
        self._mean_height = float(self._shares @ self._heights)
        done -= self._mean_done[:, None]
        precision = self._weight / spread**2
        moment = precision * (done @ (self._shares * (self._heights - self._mean_height)))
        information = precision * (np.square(done) @ self._shares) + 1 / rise**2
        self._rises = moment / information
        evidence = 0.5 * (moment * self._rises - np.log(information))
        probability = np.exp(evidence - evidence.max())
        self._probability = probability / probability.sum()

    def height(self, time: float) -> float:
        """Return the expected height at a time [m]: the mean over all strokes of the grid."""
        tau = self._elapsed + (time - self._now) / self._durations
        gone = course(tau) - self._mean_done
        return self._mean_height + float(self._probability @ (self._rises * gone))

    @cached_property
    def stroke(self) -> MinimumJerkStroke:
        """The stroke that fits best: weighted least squares, without the prior on the rise.

        Found from the likeliest stroke of the grid by the method of Levenberg and Marquardt. Its
        duration stays within the limits.
        """
        best = int(np.argmax(self._probability))
        duration = float(self._durations[best])
        stroke = self._complete(self._now - float(self._elapsed[best]) * duration, duration)
        misfit = self._misfit(stroke)
        damping = 1e-3
        for _ in range(STEPS):
            trial = self._step(stroke, damping)
            missed = self._misfit(trial)
            damping *= 0.1 if missed < misfit else 10.0
            if missed < misfit:
                settled = missed > (1 - TOLERANCE) * misfit
                stroke, misfit = trial, missed
                if settled or misfit < NEGLIGIBLE**2:
                    break
        return stroke

    def _step(self, stroke: MinimumJerkStroke, damping: float) -> MinimumJerkStroke:
        """Return the stroke after one damped Gauss-Newton step in onset and log duration."""
        gradient = stroke.gradient(self._times)
        gradient[3] *= stroke.duration
        normal = (gradient * self._shares) @ gradient.T
        normal[np.diag_indices(4)] *= 1 + damping
        normal[np.diag_indices(4)] += 1e-15
        misses = self._heights - stroke.height(self._times)
        _, _, later, longer = np.linalg.solve(normal, gradient @ (self._shares * misses)).tolist()
        duration = stroke.duration * math.exp(min(max(longer, -1.0), 1.0))
        low, high = self._limits
        return self._complete(stroke.onset + later, min(max(duration, low), high))

    def _complete(self, onset: float, duration: float) -> MinimumJerkStroke:
        """Return the stroke of that onset and duration whose start and end fit best."""
        done = course((self._times - onset) / duration)
        mean_done = float(self._shares @ done)
        weighted = self._shares * (done - mean_done)
        rise = float(weighted @ self._heights) / (float(weighted @ done) + 1e-15)
        start = self._mean_height - rise * mean_done
        return MinimumJerkStroke(start=start, end=start + rise, onset=onset, duration=duration)

    def _misfit(self, stroke: MinimumJerkStroke) -> float:
        """Return the weighted mean squared miss [m2]."""
        return float(self._shares @ np.square(self._heights - stroke.height(self._times)))


@lru_cache(maxsize=4)
def _grid(parameters: MinimumJerkFitParameters) -> tuple[Array, Array]:
    """Return duration [s] and elapsed share of every stroke of the grid, flat and read-only."""
    durations = np.geomspace(*parameters.durations, parameters.grid[0])
    elapsed = np.linspace(*parameters.elapsed, parameters.grid[1])
    grid = np.repeat(durations, len(elapsed)), np.tile(elapsed, len(durations))
    for axis in grid:
        axis.flags.writeable = False
    return grid
