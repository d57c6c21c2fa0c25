"""The playing of a recording in numbers: its sampling, its range, and the changes to it.

:class:`.Recorded` makes the same changes; a test compares the two. Its code belongs to the digests
of suites, which a report must not change.
"""

import functools
from dataclasses import asdict, dataclass

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans.recorded import FASTEST, KNOT, PEAK, ROOM_BELOW, _spline
from colift.agents.humans.recordings import Recording
from numpy.typing import NDArray

DIGITS = 4
"""Significant digits of the numbers: more than a reader needs, fewer than rounding can change."""


@dataclass(frozen=True, kw_only=True)
class Treatment:
    """The sampling and the range of a recording, and the changes to it when it is played."""

    rate_hz: float
    """Samples per second, by the median of their intervals."""
    range_m: float
    """Highest minus lowest recorded height."""
    scale: float
    """Factor of the heights; above 1, the noise of the recording is enlarged, too."""
    slow_down: float
    """Factor of the duration, at least 1, beside the ramps at both ends."""
    inverted: bool
    """Whether down became up: the hand goes further below its first height than above it."""

    def plain(self) -> dict[str, float | bool]:
        """Return the numbers by name, with :data:`DIGITS` significant digits."""
        return {
            name: value if isinstance(value, bool) else float(f"{value:.{DIGITS}g}")
            for name, value in asdict(self).items()
        }


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

    @property
    def steepest_time(self) -> float:
        """Time of the highest smoothed speed since the first sample [s]."""
        return self.knot * (float(np.abs(np.diff(self.control)).argmax()) - 0.5)


def shape_of(recording: Recording) -> Shape:
    """Return a recording as it is played, before it is scaled and slowed down."""
    times = np.array(recording.times)
    times -= times[0]
    heights = np.array(recording.heights)
    heights -= heights[0]
    inverted = bool(-heights.min() > heights.max())
    if inverted:
        heights = -heights
    duration = float(times[-1])
    knot = max(KNOT, float(np.median(np.diff(times))))
    control = np.interp(knot * np.arange(-1, np.ceil(duration / knot) + 3), times, heights)
    return Shape(duration=duration, knot=knot, control=control, inverted=inverted)


def treatment_of(recording: Recording) -> Treatment:
    """Return the sampling and the range of a recording, and the changes to it."""
    shape = shape_of(recording)
    return Treatment(
        rate_hz=1.0 / float(np.median(np.diff(recording.times))),
        range_m=max(recording.heights) - min(recording.heights),
        scale=shape.scale,
        slow_down=shape.slow_down,
        inverted=shape.inverted,
    )
