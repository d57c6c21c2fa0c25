"""Segmentation into strokes: the samples of the movement in progress."""

import math
from dataclasses import dataclass

import numpy as np
from colift.agents.estimators.minimum_jerk import Array
from colift.base.errors import InputError


@dataclass(frozen=True, kw_only=True)
class StrokeWindowParameters:
    """Parameters of :class:`StrokeWindow`."""

    rest_speed: float = 0.008
    """Below this speed a hand rests [m/s]; the highest speed of a lift is twenty times this."""
    baseline: float = 0.1
    """Time over which a speed is taken [s], or the time between two samples if that is longer; the
    height's noise of 0.23 mm becomes a noise of 3 mm/s."""
    rest: float = 0.3
    """Duration of a rest or turning point that is kept [s]."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If a value is not a positive number.
        """
        for name in ("rest_speed", "baseline", "rest"):
            if not 0 < getattr(self, name) < math.inf:
                raise InputError(f"{name} must be a positive number, got {getattr(self, name)}")


class StrokeWindow:
    """Keeps the samples since the last rest or turning point.

    A hand rests when it is slow now and was so one baseline ago. It turns when it moves against the
    direction of the stroke. Both leave only the newest samples in the window, with which the next
    stroke begins.
    """

    def __init__(self, parameters: StrokeWindowParameters | None = None) -> None:
        self._parameters = parameters or StrokeWindowParameters()
        self._times: list[float] = []
        self._heights: list[float] = []
        self._direction = 0
        self.resting = True
        """Whether the hand rests."""

    @property
    def times(self) -> Array:
        """Sample times [s], oldest first."""
        return np.array(self._times)

    @property
    def heights(self) -> Array:
        """Sampled heights [m], oldest first."""
        return np.array(self._heights)

    def add(self, time: float, height: float) -> None:
        """Add the newest sample.

        Raises
        ------
        ValueError
            If the height is not finite, or the time is not later than the last one.
        """
        if not math.isfinite(height):
            raise ValueError(f"a measured height must be finite, got {height}")
        if self._times and not time > self._times[-1]:
            raise ValueError(
                f"samples must be in order of time, got {time} after {self._times[-1]}"
            )
        self._times.append(time)
        self._heights.append(height)
        direction, before = self._directions()
        self.resting = direction == 0 and before == 0
        if self.resting or direction * self._direction < 0:
            self._forget(time - self._parameters.rest)
        self._direction = direction

    def _directions(self) -> tuple[int, int]:
        """Return the direction now and one baseline ago: 1 up, -1 down, 0 at rest."""
        newest = len(self._times) - 1
        middle = self._earlier(newest)
        return self._direction_between(middle, newest), self._direction_between(
            self._earlier(middle), middle
        )

    def _earlier(self, index: int) -> int:
        """Return the newest sample at least a baseline before another, or the one before it."""
        limit = self._times[index] - self._parameters.baseline + 1e-6
        return max(int(np.searchsorted(self._times[:index], limit, side="right")) - 1, 0)

    def _direction_between(self, first: int, last: int) -> int:
        if first == last:
            return 0
        rise = self._heights[last] - self._heights[first]
        # Over less than a baseline, noise would look like speed.
        span = max(self._times[last] - self._times[first], self._parameters.baseline)
        if abs(rise) < self._parameters.rest_speed * span:
            return 0
        return 1 if rise > 0 else -1

    def _forget(self, until: float) -> None:
        """Drop the samples before a time [s]."""
        while self._times[0] < until - 1e-6:
            del self._times[0], self._heights[0]
