"""Fit of a minimum-jerk stroke to the samples of its beginning."""

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Final

import numpy as np
from colift.agents.estimators.minimum_jerk import Array, MinimumJerkStroke, profile
from colift.agents.estimators.minimum_jerk_search import Samples
from colift.base.errors import InputError

REFERENCE_PERIOD: Final = 0.1
"""Sample spacing to which the deviation of :class:`MinimumJerkFit` refers [s]."""

FEWEST: Final = 3
"""Fewest samples of a fit."""

SPAN: Final = 5.0
"""Age of the oldest sample of a fit, in memories: the weight there is e^-5 = 0.7 %."""


@dataclass(frozen=True, kw_only=True)
class MinimumJerkFitParameters:
    """Parameters of :class:`MinimumJerkFit`."""

    durations: tuple[float, float] = (0.6, 4.5)
    """Shortest and longest stroke of the grid [s]."""
    elapsed: tuple[float, float] = (0.02, 1.5)
    """Least and largest elapsed fraction of a stroke at the newest sample; it ends at 1."""
    rise: float = 0.3
    """Standard deviation of a stroke's rise, up or down [m]: the reach of the robot's arms."""
    memory: float = 0.25
    """Time in which the weight of a sample falls to 1/e [s]: people follow the model for a while,
    not for a whole stroke."""
    grid: tuple[int, int] = (12, 30)
    """Number of durations, and of elapsed fractions, in the grid."""

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
    """Posterior of the minimum-jerk stroke whose beginning was sampled.

    Over a grid of durations and elapsed fractions, the likelihood of a stroke is

        p ~ exp(-1/2 sum_i w_i (z_i - z(t_i))^2 / deviation^2),
        w_i = exp(-(t_n - t_i) / memory) (t_i - t_(i-1)) / 0.1 s

    with start and end, in which the height is linear, integrated out: with a flat prior on the
    start and on the grid, and a normal one of mean 0 on the rise. At a higher rate each sample
    weighs less, since a person's deviation from the model lasts longer than a sample.

    Early in a stroke many durations fit equally well. Therefore :attr:`stroke` is the most likely
    one, but :meth:`height` is the mean over all, weighted by their probabilities.

    Parameters
    ----------
    times
        (n,) sample times [s], increasing, n at least 3.
    heights
        (n,) seen heights [m]; the first few from the rest before the stroke, if there was one.
    deviation
        Standard deviation of a sample around the model [m]: the sensor's noise and the person's
        deviation from the model.

    Raises
    ------
    ValueError
        If there are fewer than 3 samples, or not one height for each time.
    """

    def __init__(
        self,
        times: Array,
        heights: Array,
        deviation: float,
        parameters: MinimumJerkFitParameters | None = None,
    ) -> None:
        parameters = parameters or MinimumJerkFitParameters()
        if len(times) < FEWEST or len(times) != len(heights):
            raise ValueError(
                f"a fit needs {FEWEST} samples or more, got {len(times)} times and {len(heights)} "
                "heights"
            )
        old = int(np.searchsorted(times, times[-1] - SPAN * parameters.memory))
        first = min(old, len(times) - FEWEST)
        spacing = np.diff(times, prepend=2 * times[0] - times[1])[first:]
        self._times, self._heights = times[first:], heights[first:]
        self._now = float(times[-1])
        weights = np.exp((self._times - self._now) / parameters.memory) * spacing
        self._weight = float(weights.sum()) / REFERENCE_PERIOD
        self._weights = weights / weights.sum()
        self._limits = parameters.durations
        self._durations, self._elapsed = _grid(parameters)
        self._compare(deviation, parameters.rise)

    def _compare(self, deviation: float, rise: float) -> None:
        """Compute the best rise and the probability of each stroke of the grid."""
        ages = self._now - self._times
        done = profile(self._elapsed[:, None] - ages / self._durations[:, None])
        self._mean_done = done @ self._weights
        self._mean_height = float(self._weights @ self._heights)
        done -= self._mean_done[:, None]
        precision = self._weight / deviation**2
        moment = precision * (done @ (self._weights * (self._heights - self._mean_height)))
        self._pull = 1 / (precision * rise**2)
        information = precision * (np.square(done) @ self._weights + self._pull)
        self._rises = moment / information
        evidence = 0.5 * (moment * self._rises - np.log(information))
        probability = np.exp(evidence - evidence.max())
        self._probability = probability / probability.sum()

    def height(self, time: float) -> float:
        """Return the expected height at a time [m]: the mean over all strokes of the grid."""
        tau = self._elapsed + (time - self._now) / self._durations
        done = profile(tau) - self._mean_done
        return self._mean_height + float(self._probability @ (self._rises * done))

    @cached_property
    def stroke(self) -> MinimumJerkStroke:
        """The most likely stroke: weighted least squares, with the prior on the rise.

        The search starts at the most likely stroke of the grid and clips the duration to its range.
        """
        best = int(np.argmax(self._probability))
        duration = float(self._durations[best])
        onset = self._now - float(self._elapsed[best]) * duration
        samples = Samples(self._times, self._heights, self._weights, self._pull)
        return samples.search(onset, duration, self._limits)


@lru_cache(maxsize=4)
def _grid(parameters: MinimumJerkFitParameters) -> tuple[Array, Array]:
    """Return duration [s] and elapsed fraction of every stroke of the grid, flat and read-only."""
    durations = np.geomspace(*parameters.durations, parameters.grid[0])
    elapsed = np.linspace(*parameters.elapsed, parameters.grid[1])
    grid = np.repeat(durations, len(elapsed)), np.tile(elapsed, len(durations))
    for axis in grid:
        axis.flags.writeable = False
    return grid
