"""A recording as it is played: smoothed, and of any size and pace."""

import functools
from dataclasses import dataclass

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.estimators.minimum_jerk import profile
from colift.agents.humans.recorded import (
    EASE,
    FASTEST,
    KNOT,
    PEAK,
    RETURN,
    ROOM_BELOW,
    _spline,
)
from colift.agents.humans.recordings import Recording
from colift.agents.humans.stroke import stroke
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True, eq=False)
class Shape:
    """A recording as it is played, before it is scaled and slowed down."""

    duration: float
    """Duration of the recording [s]."""
    knot: float
    """Interval of the control points [s]."""
    control: NDArray[np.float64]
    """Heights of the control points [m], shape (n,), the first one at ``-knot``."""
    inverted: bool

    def heights(self, points: int) -> NDArray[np.float64]:
        """Return smoothed heights [m], evenly over the duration, shape (points,)."""
        return _spline(self.control, np.linspace(0.0, self.duration / self.knot, points))

    @functools.cached_property
    def _all(self) -> NDArray[np.float64]:
        """Smoothed heights above the start, at four times the rate of a plan [m]."""
        smooth = self.heights(4 * round(self.duration / FRAME) + 2)
        smooth -= smooth[0]
        return smooth

    @property
    def highest(self) -> float:
        """Largest smoothed height above the start [m]."""
        return float(self._all.max())

    @property
    def dip(self) -> float:
        """Largest smoothed depth below the start [m]."""
        return float(-self._all.min())

    @property
    def scale(self) -> float:
        """Factor of the heights; the movement must not be flat."""
        if self.dip * PEAK <= ROOM_BELOW * self.highest:
            return PEAK / self.highest
        return ROOM_BELOW / self.dip

    @property
    def slow_down(self) -> float:
        """Factor of the duration; the movement must not be flat."""
        steepest = float(np.abs(np.diff(self.control)).max()) / self.knot
        return max(self.scale * steepest / FASTEST, 1.0)

    def times(self, slow_down: float) -> NDArray[np.float64]:
        """Return the recorded time in each frame in which it is played [s], from the first sample.

        Its pace is 0 at both ends, and ``1 / slow_down`` beyond the ramps of :data:`.EASE`.
        """
        return self.knot * self._knots(slow_down)

    def _knots(self, slow_down: float) -> NDArray[np.float64]:
        """Return the recorded time in each frame in which it is played, in knots."""
        full_pace = int(np.ceil(self.duration * slow_down / FRAME))
        ease = min(round(EASE / FRAME), full_pace)
        ramp = profile(np.arange(1, ease + 1) / ease)
        pace = np.ones(full_pace + ease)
        pace[:ease] = ramp
        pace[-ease:] = ramp[::-1]
        time: NDArray[np.float64] = pace.cumsum()
        time *= self.duration / (self.knot * time[-1])
        return time

    def played(self, scale: float, slow_down: float) -> NDArray[np.float64]:
        """Return the movement at 100 Hz, from height 0 and back to it [m].

        Over :data:`.EASE` it accelerates to full pace, and slows down at its end; then the hand
        returns from the last height to the start.

        Parameters
        ----------
        scale, slow_down
            Factors of the heights and of the duration.
        """
        time = self._knots(slow_down)
        lift = scale * _spline(self.control - self.heights(2)[0], time)
        end = float(lift[-1])
        shortest, speed = RETURN
        back = stroke(-end, max(shortest, 1.875 * abs(end) / speed))[0]
        overlap = min(round(EASE / FRAME), len(lift) // 2) // 2
        whole = np.concatenate((lift, np.full(len(back) - overlap, end)))
        whole[len(lift) - overlap :] += back
        return whole

    @property
    def steepest_time(self) -> float:
        """Time of the highest smoothed speed since the first sample [s]."""
        return self.knot * (float(np.abs(np.diff(self.control)).argmax()) - 0.5)


def shape_of(recording: Recording, *, invert: bool = True) -> Shape:
    """Return a recording as it is played, before it is scaled and slowed down.

    It is inverted if the hand goes further below its first height than above it, unless ``invert``
    is false.
    """
    times = np.array(recording.times)
    times -= times[0]
    heights = np.array(recording.heights)
    heights -= heights[0]
    inverted = invert and bool(-heights.min() > heights.max())
    if inverted:
        heights = -heights
    duration = float(times[-1])
    knot = max(KNOT, float(np.median(np.diff(times))))
    control = np.interp(knot * np.arange(-1, np.ceil(duration / knot) + 3), times, heights)
    return Shape(duration=duration, knot=knot, control=control, inverted=inverted)
