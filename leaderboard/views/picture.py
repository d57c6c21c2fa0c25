"""The picture of a board: how level against how smooth, with the front of the best."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

from ...benchmark.comparison.comparison import Point, pareto_front
from ...benchmark.comparison.scale import Scale, Spot, make_scale
from ..board.standings import HumanHumanScores
from ..records.row import BoardRow
from .bounds import PublicBound
from .dots import LETTER, LINE, Box, Dot, Label, Place, labels_beside

LEFT: Final = 56
RIGHT: Final = 12
TOP: Final = 14
BOTTOM: Final = 46
"""Margins [px]."""

BEYOND: Final = ("off the scale", "beyond")
STILL: Final = ("does not move along: no smoothness", "no smoothness")
"""What stands in the strips at the right and below, where there is room and where there is not."""

ROOM: Final = 600
"""Breadth from which on there is room [px]."""


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
    """The policies, best first; then the human-human team, and the bounds."""
    labels: tuple[Label, ...]
    stair: str
    """Points of the front's line, as SVG has them."""
    across: tuple[Tick, ...]
    """RMSE on the hidden lifts [mm]."""
    up: tuple[Tick, ...]
    """SPARC on the public lifts."""
    beyond: tuple[float, str] | None
    """From where on to the right is off the scale, and what stands there."""
    still: tuple[float, str] | None
    """From where on down is without smoothness, and what stands there."""
    team: float | None
    """Where the human-human team's RMSE is."""
    words: str
    """The picture in a sentence."""


def make_picture(
    rows: Sequence[BoardRow],
    team: HumanHumanScores | None,
    bounds: Sequence[PublicBound] = (),
    *,
    width: int,
    height: int,
) -> Picture | None:
    """Return the picture; None if there is no policy.

    Parameters
    ----------
    rows
        The policies, best first: RMSE on the hidden lifts, as in the table, and smoothness on the
        public ones.
    team
        The human-human team on the hidden lifts.
    bounds
        Those of the public lifts.
    width, height
        Size [px].
    """
    if not rows:
        return None
    spots = [_spot(row) for row in rows]
    marks = [
        *(() if team is None else [(_mark("two people", team), "team")]),
        *((_mark(bound.name, bound), "bound") for bound in bounds),
    ]
    scale = make_scale([*spots, *(mark for mark, _ in marks)])
    plot = (LEFT, TOP, width - RIGHT, height - BOTTOM)
    place = _Place(scale=scale, plot=plot)
    points = {row.submission: _point(row) for row in sorted(rows, key=_rmse)}
    front = pareto_front(points)
    dots = tuple(
        _dot(spot, place, row.submission, front=row.submission in front)
        for row, spot in zip(rows, spots, strict=True)
    )
    beside = tuple(_dot(mark, place, "", kind=kind) for mark, kind in marks)
    stair = _stair(dots, front)
    line = None if team is None else place.x(team.rmse_mm.mean)
    lines = list(pairwise(stair))
    texts: list[Box] = []
    if line is not None:
        lines.append(((line, plot[1]), (line, plot[3])))
    beyond, still = BEYOND[width < ROOM], STILL[width < ROOM]
    if scale.beyond:
        texts.append((plot[2] - LETTER * len(beyond), plot[1], plot[2], plot[1] + LINE))
    if scale.still:
        texts.append((plot[0], plot[3] - LINE - 4, plot[0] + LETTER * len(still), plot[3]))
    return Picture(
        width=width,
        height=height,
        plot=plot,
        dots=(*dots, *beside),
        labels=labels_beside((*beside, *dots), plot, texts=texts, lines=lines),
        stair=" ".join(f"{x},{y}" for x, y in stair),
        across=tuple(Tick(at=place.x(mm), text=f"{mm:g}") for mm in _ticks(*scale.x)),
        up=tuple(Tick(at=place.y(s), text=_minus(f"{s:g}")) for s in _ticks(*scale.y)),
        beyond=(place.x(scale.x[1]), beyond) if scale.beyond else None,
        still=(place.y(scale.y[0]), still) if scale.still else None,
        team=line,
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


def _spot(row: BoardRow) -> Spot:
    return Spot(
        name=row.name,
        x=row.hidden.rmse_mm.mean,
        x_bar=row.hidden.rmse_mm.ci95,
        y=row.public.metrics["sparc"].mean,
        y_bar=None,
        missing=row.public.metrics["sparc"].missing > 0,
        colour="",
    )


def _mark(name: str, other: HumanHumanScores | PublicBound) -> Spot:
    return Spot(
        name=name,
        x=other.rmse_mm.mean,
        x_bar=other.rmse_mm.ci95,
        y=other.means["sparc"],
        y_bar=None,
        colour="",
        bound=True,
    )


def _rmse(row: BoardRow) -> float:
    return row.hidden.rmse_mm.mean


def _point(row: BoardRow) -> Point:
    sparc = row.public.metrics["sparc"]
    return Point(rmse_mm=_rmse(row), sparc=sparc.mean, missing=sparc.missing)


def _dot(
    spot: Spot, place: _Place, submission: str, *, front: bool = False, kind: str = "policy"
) -> Dot:
    at_x, at_y = place.scale.place(spot)
    x = place.x(at_x)
    off = place.scale.off(spot)
    smooth = "no smoothness" if spot.y is None else f"SPARC {_minus(f'{spot.y:.2f}')}"
    return Dot(
        name=_named(spot, at_y, off),
        submission=submission,
        x=x,
        y=place.y(at_y),
        low=x if off else place.x(spot.x_bar[0]),
        high=x if off else place.x(min(spot.x_bar[1], place.scale.x[1])),
        front=front,
        told=f"{spot.name}: RMSE {spot.x:.1f} mm, {smooth}",
        kind=kind,
    )


def _named(spot: Spot, at_y: float, off: bool) -> str:
    """Return a spot's name, with the values that its place does not tell."""
    told = [f"{spot.x:.0f} mm"] if off else []
    if spot.y is not None and spot.y < at_y:
        told.append(f"SPARC {_minus(f'{spot.y:.1f}')}")
    return f"{spot.name} ({', '.join(told)})" if told else spot.name


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


def _words(rows: Sequence[BoardRow], front: Sequence[str]) -> str:
    names = {row.submission: row.name for row in rows}
    best = ", ".join(names[digest] for digest in front) or "none"
    return (
        f"{len(rows)} policies by RMSE (across, further left is more level) and smoothness (up, "
        f"higher is smoother). Not beaten in both by any other: {best}."
    )
