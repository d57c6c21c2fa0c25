"""The picture of a board: how level against how smooth, with the front of the best."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

from ...benchmark.comparison.front import Point, pareto_front
from ...benchmark.comparison.scale import Scale, Spot, make_scale
from ..row import Row
from .dots import LETTER, LINE, Box, Dot, Label, Place, labels_beside

LEFT: Final = 56
RIGHT: Final = 12
TOP: Final = 14
BOTTOM: Final = 46
"""Margins [px]."""


@dataclass(frozen=True, kw_only=True)
class Tick:
    """A place on an axis."""

    at: float
    text: str


@dataclass(frozen=True, kw_only=True)
class Picture:
    """All that is drawn, in pixels from the top left."""

    width: int
    height: int
    plot: Box
    dots: tuple[Dot, ...]
    labels: tuple[Label, ...]
    stair: str
    """Points of the front's line, as SVG has them."""
    across: tuple[Tick, ...]
    """RMSE [mm]."""
    up: tuple[Tick, ...]
    """SPARC."""
    beyond: float | None
    """From where on to the right is off the scale."""
    still: float | None
    """From where on down is without smoothness."""
    team: float | None
    """Where the human-human team's RMSE is."""
    words: str
    """The picture in a sentence."""


def make_picture(
    rows: Sequence[Row], team_rmse_mm: float | None, *, width: int, height: int
) -> Picture | None:
    """Return the picture of the public lifts; None if there is no policy.

    Parameters
    ----------
    rows
        The policies, best first.
    team_rmse_mm
        The human-human team on the same lifts.
    width, height
        Size [px].
    """
    if not rows:
        return None
    spots = [_spot(row) for row in rows]
    scale = make_scale(spots if team_rmse_mm is None else [*spots, _team(team_rmse_mm, spots)])
    plot = (LEFT, TOP, width - RIGHT, height - BOTTOM)
    place = _Place(scale=scale, plot=plot)
    points = {row.submission: _point(row) for row in sorted(rows, key=_rmse)}
    front = pareto_front(points)
    dots = tuple(
        _dot(row, spot, place, row.submission in front)
        for row, spot in zip(rows, spots, strict=True)
    )
    stair = _stair(dots, front)
    team = None if team_rmse_mm is None else place.x(team_rmse_mm)
    lines = list(pairwise(stair))
    texts: list[Box] = []
    if team is not None:
        lines.append(((team, plot[1]), (team, plot[3])))
        texts.append((team, plot[1], team + LETTER * len("two people"), plot[1] + LINE))
    if scale.beyond:
        texts.append((plot[2] - LETTER * len("off the scale"), plot[1], plot[2], plot[1] + LINE))
    beyond, still = place.x(scale.x[1]), place.y(scale.y[0])
    return Picture(
        width=width,
        height=height,
        plot=plot,
        dots=dots,
        labels=labels_beside(dots, plot, texts=texts, lines=lines),
        stair=" ".join(f"{x},{y}" for x, y in stair),
        across=tuple(Tick(at=place.x(mm), text=f"{mm:g}") for mm in _ticks(*scale.x)),
        up=tuple(Tick(at=place.y(s), text=_minus(f"{s:g}")) for s in _ticks(*scale.y)),
        beyond=beyond if scale.beyond else None,
        still=still if scale.still else None,
        team=team,
        words=_words(rows, front),
    )


@dataclass(frozen=True, kw_only=True)
class _Place:
    """From millimetres and SPARC to pixels."""

    scale: Scale
    plot: Box

    def x(self, value: float) -> float:
        left, _, right, _ = self.plot
        low, high = self.scale.x[0], self.scale.right
        return round(left + (right - left) * (value - low) / (high - low), 1)

    def y(self, value: float) -> float:
        _, top, _, bottom = self.plot
        low, high = self.scale.bottom, self.scale.y[1]
        return round(bottom - (bottom - top) * (value - low) / (high - low), 1)


def _spot(row: Row) -> Spot:
    public = row.public
    return Spot(
        name=row.name,
        x=public.rmse_mm.mean,
        x_bar=public.rmse_mm.ci95,
        y=public.sparc,
        y_bar=None,
        missing=public.sparc_missing > 0,
        colour="",
    )


def _team(rmse_mm: float, spots: Sequence[Spot]) -> Spot:
    """Return the team, as smooth as some policy, so that its line is on the scale."""
    bar = (rmse_mm, rmse_mm)
    y = next((spot.y for spot in spots if spot.y is not None), None)
    return Spot(name="", x=rmse_mm, x_bar=bar, y=y, y_bar=None, colour="")


def _rmse(row: Row) -> float:
    return row.public.rmse_mm.mean


def _point(row: Row) -> Point:
    public = row.public
    return Point(rmse_mm=public.rmse_mm.mean, sparc=public.sparc, missing=public.sparc_missing)


def _dot(row: Row, spot: Spot, place: _Place, front: bool) -> Dot:
    at_x, at_y = place.scale.place(spot)
    x = place.x(at_x)
    off = place.scale.off(spot)
    smooth = "no smoothness" if spot.y is None else f"SPARC {_minus(f'{spot.y:.2f}')}"
    return Dot(
        name=row.name,
        submission=row.submission,
        x=x,
        y=place.y(at_y),
        low=x if off else place.x(spot.x_bar[0]),
        high=x if off else place.x(min(spot.x_bar[1], place.scale.x[1])),
        front=front,
        told=f"{row.name}: RMSE {spot.x:.1f} mm, {smooth}",
    )


def _stair(dots: Sequence[Dot], front: Sequence[str]) -> list[Place]:
    """Return the corners of the front's line."""
    places = {dot.submission: (dot.x, dot.y) for dot in dots}
    corners: list[Place] = []
    for x, y in (places[digest] for digest in front):
        if corners:
            corners.append((x, corners[-1][1]))
        corners.append((x, y))
    return corners


def _ticks(low: float, high: float) -> list[float]:
    """Return round numbers between two ends, about five."""
    for step in (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100):
        if (high - low) / step <= 6:
            break
    first = -int(-low // step)
    return [round(step * i, 6) for i in range(first, int(high // step) + 1)]


def _minus(text: str) -> str:
    return text.replace("-", "\N{MINUS SIGN}")


def _words(rows: Sequence[Row], front: Sequence[str]) -> str:
    names = {row.submission: row.name for row in rows}
    best = ", ".join(names[digest] for digest in front) or "none"
    return (
        f"{len(rows)} policies by RMSE (across, further left is more level) and smoothness (up, "
        f"higher is smoother). Not beaten in both by any other: {best}."
    )
