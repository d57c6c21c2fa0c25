"""The names in a picture: beside their dots, where there is room.

A page is made whenever it is asked for, so each name takes the first place that is free;
:mod:`...benchmark.rendering.labels` takes its time for the best.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

LETTER: Final = 6.4
"""Breadth of a letter [px], about."""
LINE: Final = 15
"""Height of a line of letters [px]."""
RADIUS: Final = 5
"""Of a dot [px]."""

NAMED: Final = 40
"""Dots that get their name, at most: the front, then the best."""

Box = tuple[float, float, float, float]
"""Left, top, right, bottom [px]."""

Place = tuple[float, float]
"""From the left, from the top [px]."""


@dataclass(frozen=True, kw_only=True)
class Dot:
    """A policy in the picture."""

    name: str
    submission: str
    x: float
    y: float
    low: float
    high: float
    """Ends of the RMSE's interval [px]."""
    front: bool
    """Whether no other is both more level and smoother."""
    told: str
    """What it is, in words."""


@dataclass(frozen=True, kw_only=True)
class Label:
    """A name beside its dot."""

    x: float
    y: float
    anchor: str
    text: str
    front: bool


def labels_beside(
    dots: Sequence[Dot], plot: Box, *, texts: Iterable[Box], lines: Iterable[tuple[Place, Place]]
) -> tuple[Label, ...]:
    """Return names where there is room: first on the front, then in the order of the table.

    Parameters
    ----------
    dots
        The policies, in the order of the table.
    plot
        Where names may be.
    texts
        Where other words stand.
    lines
        Lines, each straight up or across, that names do not cross if they can stand elsewhere.
    """
    taken = [*map(_around, dots), *texts]
    drawn = [_covered(*line) for line in lines]
    labels = []
    for dot in sorted(dots, key=lambda dot: not dot.front)[:NAMED]:
        found = _free(dot, plot, [*taken, *drawn]) or _free(dot, plot, taken)
        if found is not None:
            labels.append(found[0])
            taken.append(found[1])
    return tuple(labels)


def _free(dot: Dot, plot: Box, taken: Sequence[Box]) -> tuple[Label, Box] | None:
    """Return the first place of a name that is inside and covers nothing."""
    for label, box in _candidates(dot):
        inside = plot[0] <= box[0] and box[2] <= plot[2] and plot[1] <= box[1] and box[3] <= plot[3]
        if inside and not any(_overlap(box, each) for each in taken):
            return label, box
    return None


def _candidates(dot: Dot) -> Iterator[tuple[Label, Box]]:
    breadth, gap = LETTER * len(dot.name), RADIUS + 5
    for anchor, x, y in (
        ("start", dot.x + 3, dot.y - gap),
        ("end", dot.x - 3, dot.y - gap),
        ("start", dot.x + 3, dot.y + RADIUS + 13),
        ("end", dot.x - 3, dot.y + RADIUS + 13),
        ("start", dot.x + gap, dot.y + 4),
        ("end", dot.x - gap, dot.y + 4),
        ("middle", dot.x, dot.y - gap),
        ("middle", dot.x, dot.y + RADIUS + 13),
    ):
        left = x - breadth * {"start": 0.0, "middle": 0.5, "end": 1.0}[anchor]
        label = Label(x=round(x, 1), y=round(y, 1), anchor=anchor, text=dot.name, front=dot.front)
        yield label, (left, y - LINE + 4, left + breadth, y + 4)


def _around(dot: Dot) -> Box:
    return dot.x - RADIUS, dot.y - RADIUS, dot.x + RADIUS, dot.y + RADIUS


def _covered(one: Place, other: Place) -> Box:
    """Return what a line covers, a pixel to each side."""
    (left, right), (top, bottom) = (sorted(each) for each in zip(one, other, strict=True))
    return left - 1, top - 1, right + 1, bottom + 1


def _overlap(a: Box, b: Box) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]
