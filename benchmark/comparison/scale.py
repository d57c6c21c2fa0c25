"""The part of a scatter plot that is drawn to scale, and the points beside it."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..rendering.style import FAINT, HUMAN, ROBOT
from ..statistics import Interval
from .comparison import Comparison
from .contest import TEAM
from .standing import Standing

FAR: Final = 3.0
"""A policy is off the scale from so many times the median error on: it would squeeze the rest."""

STRIP: Final = 0.13
"""Breadth of a strip for what is off the scale, over that of the scale."""

Box = tuple[float, float, float, float]
"""Left, bottom, right and top, in millimetres and SPARC."""

MARGIN: Final = 0.09
"""Room around the points, over the breadth of the scale."""


@dataclass(frozen=True, kw_only=True)
class Spot:
    """A labelled point of the picture."""

    name: str
    x: float
    """RMSE [mm]."""
    x_bar: Interval
    y: float | None
    """SPARC; nothing if the robot does not move."""
    y_bar: Interval | None
    """Nothing if it is not known."""
    missing: bool = False
    """Whether it has no smoothness in some of the lifts."""
    colour: str
    marker: str = "o"
    filled: bool = True
    bound: bool = False
    """Whether it is no robot that can be had: what is far off is so for those that can."""


@dataclass(frozen=True, kw_only=True)
class Scale:
    """The part that is drawn to scale, and the strips at its right and below."""

    x: Interval
    y: Interval
    beyond: bool
    """Whether some policy is off the scale, at the right."""
    still: bool
    """Whether some policy has no smoothness; it lies below."""

    @property
    def right(self) -> float:
        """Where the picture ends at the right."""
        return self.x[1] + (STRIP * (self.x[1] - self.x[0]) if self.beyond else 0.0)

    @property
    def bottom(self) -> float:
        """Where the picture ends below."""
        return self.y[0] - (STRIP * (self.y[1] - self.y[0]) if self.still else 0.0)

    def off(self, spot: Spot) -> bool:
        """Whether the spot's error is off the scale."""
        return spot.x > self.x[1]

    def place(self, spot: Spot) -> tuple[float, float]:
        """Return where a spot is drawn: in the middle of a strip, if it is off the scale."""
        x = (self.x[1] + self.right) / 2 if self.off(spot) else spot.x
        if spot.y is None:
            return x, (self.y[0] + self.bottom) / 2
        margin = MARGIN / 2 * (self.y[1] - self.y[0])
        return x, min(max(spot.y, self.y[0] + margin), self.y[1] - margin)

    def bars(self, spot: Spot) -> list[Box]:
        """Return the intervals of a spot, as boxes without breadth; none off the scale."""
        if self.off(spot):
            return []
        x, y = self.place(spot)
        bars = [(spot.x_bar[0], y, spot.x_bar[1], y)]
        return bars if spot.y_bar is None else [*bars, (x, spot.y_bar[0], x, spot.y_bar[1])]


def spots(comparison: Comparison) -> list[Spot]:
    """Return the policies, the most level first, then the human-human team and the bounds."""
    baselines = comparison.contest.baselines
    return [
        *(_spot(standing, comparison.front) for standing in comparison.overall.standings),
        *(
            Spot(
                name=name,
                x=rmse.mean,
                x_bar=rmse.ci95,
                y=baselines[name].means["sparc"],
                y_bar=None,
                colour=HUMAN,
                marker="D" if name == TEAM else "s",
                filled=name == TEAM,
                bound=name != TEAM,
            )
            for name, rmse in comparison.overall.baselines_rmse_mm.items()
        ),
    ]


def _spot(standing: Standing, front: Sequence[str]) -> Spot:
    sparc, best = standing.sparc, standing.name in front
    return Spot(
        name=standing.name,
        x=standing.rmse_mm.mean,
        x_bar=standing.rmse_mm.ci95,
        y=sparc.mean if sparc else None,
        y_bar=sparc.ci95 if sparc else None,
        missing=sparc is not None and standing.sparc_missing > 0,
        colour=ROBOT if best else FAINT,
        filled=best,
    )


def make_scale(drawn: Sequence[Spot]) -> Scale:
    """Return a scale that shows most of the spots; those far off do not count."""
    far = FAR * float(np.median([spot.x for spot in drawn if not spot.bound]))
    near = [spot for spot in drawn if spot.x <= far]
    heights = [end for spot in near for end in (spot.y, *(spot.y_bar or ())) if end is not None]
    return Scale(
        x=_padded([end for spot in near for end in spot.x_bar]),
        y=_padded(heights or [0.0]),
        beyond=len(near) < len(drawn),
        still=any(spot.y is None for spot in drawn),
    )


def _padded(values: Sequence[float]) -> Interval:
    low, high = min(values), max(values)
    margin = MARGIN * max(high - low, 0.1 * abs(high), 1e-3)
    return low - margin, high + margin
