"""A fit of the minimum-jerk movement to the samples of a stroke so far."""

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Final

import numpy as np

from ..errors import InputError
from .minimum_jerk import Array, MinimumJerkStroke, course
from .minimum_jerk_search import Samples

REFERENCE_PERIOD: Final = 0.1
"""Spacing of the samples [s] to which the spread of :class:`MinimumJerkFit` refers."""

FEWEST: Final = 3
"""Fewest samples of a fit."""

SPAN: Final = 5.0
"""A sample older than this many memories has next to no weight (e^-5 = 0.7 %) and is left out."""


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

    Over a grid of durations and of shares gone by, the likelihood of a stroke is

        p ~ exp(-1/2 sum_i w_i (z_i - z(t_i))^2 / spread^2),
        w_i = exp(-(t_n - t_i) / memory) (t_i - t_(i-1)) / 0.1 s

    with start and end, in which the height is linear, integrated out: by a flat prior on the start
    and on the grid, and a normal one of mean 0 on the rise. Samples at a higher rate weigh less
    each, since what a person does otherwise than the model lasts longer than a sample.

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
        self._pull = 1 / (precision * rise**2)
        information = precision * (np.square(done) @ self._shares + self._pull)
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
        """The likeliest stroke: weighted least squares, with the prior on the rise.

        Searched for from the likeliest stroke of the grid; its duration stays within the limits.
        """
        best = int(np.argmax(self._probability))
        duration = float(self._durations[best])
        onset = self._now - float(self._elapsed[best]) * duration
        samples = Samples(self._times, self._heights, self._shares, self._pull)
        return samples.search(onset, duration, self._limits)


@lru_cache(maxsize=4)
def _grid(parameters: MinimumJerkFitParameters) -> tuple[Array, Array]:
    """Return duration [s] and elapsed share of every stroke of the grid, flat and read-only."""
    durations = np.geomspace(*parameters.durations, parameters.grid[0])
    elapsed = np.linspace(*parameters.elapsed, parameters.grid[1])
    grid = np.repeat(durations, len(elapsed)), np.tile(elapsed, len(durations))
    for axis in grid:
        axis.flags.writeable = False
    return grid
