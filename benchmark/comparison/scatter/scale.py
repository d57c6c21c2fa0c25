"""Map from errors and another metric to pixels, with strips for points off the scale."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from colift.benchmark.comparison.front import FrontPoint
from colift.benchmark.episode.metric import Metric
from colift.benchmark.rendering.ticks import far_limit
from colift.benchmark.statistics import Interval

STRIP: Final = 0.115
"""Breadth of a strip for points off the scale, relative to that of the plot."""

MARGIN: Final = 0.09
"""Room around the points, relative to the breadth of the scale."""

LEAST: Final = 0.8
"""Least breadth from which the room is computed, if points are alike [mm, or unit of the
metric]."""

Place = tuple[float, float]
"""Pixels from the left and from the top."""

Box = tuple[float, float, float, float]
"""Left, top, right and bottom [px]."""


@dataclass(frozen=True, kw_only=True)
class Scale:
    """The part of the plot that is drawn to scale, and the strips at its right and below."""

    plot: Box
    """Scale and strips."""
    x: Interval
    """RMSE at the left and at the right end of the scale [mm]."""
    y: Interval
    """The metric at the lower and at the upper end of the scale: better is up."""
    beyond: bool
    """Whether some error is off the scale: its point is in the strip at the right."""
    still: bool
    """Whether some point has no value of the metric: it is in the strip below."""

    @property
    def inner(self) -> Box:
        """The part drawn to scale."""
        left, top, right, bottom = self.plot
        return (
            left,
            top,
            right - self.beyond * STRIP * (right - left),
            bottom - self.still * STRIP * (bottom - top),
        )

    def across(self, rmse_mm: float) -> float:
        """Return the place of an error [px from the left]."""
        left, _, right, _ = self.inner
        return left + (right - left) * (rmse_mm - self.x[0]) / (self.x[1] - self.x[0])

    def down(self, value: float) -> float:
        """Return the place of a value of the metric [px from the top]."""
        _, top, _, bottom = self.inner
        return bottom - (bottom - top) * (value - self.y[0]) / (self.y[1] - self.y[0])

    def off(self, point: FrontPoint) -> bool:
        """Return whether the error of a point is off the scale."""
        return point.rmse_mm.mean > self.x[1]

    def below(self, point: FrontPoint) -> bool:
        """Return whether a point has a value worse than the scale shows."""
        low, high = self.y
        return point.second is not None and (point.second.mean - low) * (high - low) < 0

    def place(self, point: FrontPoint) -> Place:
        """Return the place of a point; off the scale, the middle of a strip, or the edge."""
        _, top, right, bottom = self.inner
        off, margin = self.off(point), MARGIN / 2 * (bottom - top)
        x = (right + self.plot[2]) / 2 if off else self.across(point.rmse_mm.mean)
        if point.second is None:
            return x, (bottom + self.plot[3]) / 2
        return x, min(max(self.down(point.second.mean), top + margin), bottom - margin)

    def bars(self, point: FrontPoint) -> tuple[Box, ...]:
        """Return the 95 % intervals of a point, as lines; none off the scale."""
        if self.off(point):
            return ()
        x, y = self.place(point)
        _, top, right, bottom = self.inner
        low, high = point.rmse_mm.ends
        bars = [(self.across(low), y, min(self.across(high), right), y)]
        if point.second is not None and not self.below(point):
            upper, lower = sorted(self.down(end) for end in point.second.ends)
            bars.append((x, max(upper, top), x, min(lower, bottom)))
        return tuple(bar for bar in bars if bar[:2] != bar[2:])


def make_scale(points: Sequence[FrontPoint], plot: Box, metric: Metric) -> Scale:
    """Return a scale that shows most of the points; those far off do not count."""
    far = far_limit([point.rmse_mm.mean for point in points if point.kind != "reference"])
    near = [point for point in points if point.rmse_mm.mean <= far]
    shown = [each.second for each in near if each.second]
    low, high = _padded([end for each in shown for end in (each.mean, *each.ends)] or [0.0])
    return Scale(
        plot=plot,
        x=_padded([end for point in near for end in point.rmse_mm.ends]),
        y=(low, high) if metric.better == "more" else (high, low),
        beyond=len(near) < len(points),
        still=any(point.second is None for point in points),
    )


def _padded(values: Sequence[float]) -> Interval:
    low, high = min(values), max(values)
    margin = MARGIN * max(high - low, 0.1 * abs(high), LEAST)
    return low - margin, high + margin
