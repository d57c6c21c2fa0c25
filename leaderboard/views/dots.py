"""The names in a picture: beside their dots, where there is room, else at the end of a line.

A page is made whenever it is asked for, so each name takes the first place that is free;
:mod:`...benchmark.rendering.labels` takes its time for the best.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

LETTER: Final = 7.0
"""Breadth of a letter [px], at most about."""
BOLD: Final = 7.6
"""The same, of a bold one."""
LINE: Final = 15
"""Height of a line of letters [px]."""
RADIUS: Final = 5
"""Of a dot [px]."""
CLEAR: Final = 3
"""What is left free between words [px]."""

NAMED: Final = 40
"""Dots that get their name, at most: the front, then the best."""

DISTANCES: Final = (26.0, 38.0, 52.0, 68.0, 86.0)
"""From a dot to a name that does not fit beside it [px]."""

DIRECTIONS: Final = 16
"""In so many directions a farther place is looked for."""

Box = tuple[float, float, float, float]
"""Left, top, right, bottom [px]."""

Place = tuple[float, float]
"""From the left, from the top [px]."""


@dataclass(frozen=True, kw_only=True)
class Dot:
    """A policy in the picture, or what it is set against."""

    name: str
    """What stands beside it."""
    submission: str
    """Digest; empty for what is no policy."""
    x: float
    y: float
    low: float
    high: float
    """Ends of the RMSE's interval [px]."""
    front: bool
    """Whether no other is both more level and smoother."""
    told: str
    """What it is, in words."""
    kind: str = "policy"
    """``policy``, ``team`` or ``bound``."""


@dataclass(frozen=True, kw_only=True)
class Label:
    """A name beside its dot."""

    x: float
    y: float
    anchor: str
    text: str
    front: bool
    kind: str
    leader: tuple[float, float, float, float] | None
    """A line from the dot to a name that stands away from it: both ends [px]."""

    @property
    def box(self) -> Box:
        """What it covers [px], at most about."""
        breadth = (BOLD if self.front or self.kind == "team" else LETTER) * len(self.text)
        left = self.x - breadth * {"start": 0.0, "middle": 0.5, "end": 1.0}[self.anchor]
        return left, self.y - LINE + 4, left + breadth, self.y + 4


def labels_beside(
    dots: Sequence[Dot], plot: Box, *, texts: Iterable[Box], lines: Iterable[tuple[Place, Place]]
) -> tuple[Label, ...]:
    """Return names where there is room: first on the front, then in the order of the table.

    None covers another one, a dot, or other words. A name that fits nowhere is left out: the
    dot still tells it.

    Parameters
    ----------
    dots
        What is named, in the order of the table.
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
        label = _free(dot, plot, [*taken, *drawn]) or _free(dot, plot, taken)
        if label is not None:
            labels.append(label)
            taken.append(label.box)
    return tuple(labels)


def _free(dot: Dot, plot: Box, taken: Sequence[Box]) -> Label | None:
    """Return the first place of a name that is inside and covers nothing."""
    others = [box for box in taken if box != _around(dot)]
    for label in (*_beside(dot), *_away(dot)):
        box = label.box
        inside = plot[0] <= box[0] and box[2] <= plot[2] and plot[1] <= box[1] and box[3] <= plot[3]
        if inside and not any(_overlap(_wider(box), each) for each in taken):
            crossed = label.leader and any(_crosses(label.leader, each) for each in others)
            if not crossed:
                return label
    return None


def _beside(dot: Dot) -> Iterator[Label]:
    gap = RADIUS + 5
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
        yield _label(dot, anchor, x, y, None)


def _away(dot: Dot) -> Iterator[Label]:
    """Yield places farther off, with a line from the dot."""
    for distance in DISTANCES:
        for number in range(DIRECTIONS):
            angle = 2 * math.pi * (number + 0.5) / DIRECTIONS
            across, down = math.cos(angle), math.sin(angle)
            x, y = dot.x + distance * across, dot.y + distance * down
            near = RADIUS + 1
            leader = (dot.x + near * across, dot.y + near * down, x, y)
            anchor = "start" if across >= 0 else "end"
            yield _label(dot, anchor, x + math.copysign(3, across), y + 4, leader)


def _label(
    dot: Dot, anchor: str, x: float, y: float, leader: tuple[float, float, float, float] | None
) -> Label:
    return Label(
        x=round(x, 1),
        y=round(y, 1),
        anchor=anchor,
        text=dot.name,
        front=dot.front,
        kind=dot.kind,
        leader=leader,
    )


def _around(dot: Dot) -> Box:
    return dot.x - RADIUS, dot.y - RADIUS, dot.x + RADIUS, dot.y + RADIUS


def _wider(box: Box) -> Box:
    return box[0] - CLEAR, box[1], box[2] + CLEAR, box[3]


def _covered(one: Place, other: Place) -> Box:
    """Return what a line covers, a pixel to each side."""
    (left, right), (top, bottom) = (sorted(each) for each in zip(one, other, strict=True))
    return left - 1, top - 1, right + 1, bottom + 1


def _overlap(a: Box, b: Box) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def _crosses(line: tuple[float, float, float, float], box: Box) -> bool:
    """Return whether a short line goes through a box: looked at in steps of its length."""
    x1, y1, x2, y2 = line
    steps = max(2, int(math.hypot(x2 - x1, y2 - y1) / 3))
    places = ((x1 + (x2 - x1) * i / steps, y1 + (y2 - y1) * i / steps) for i in range(steps + 1))
    return any(box[0] <= x <= box[2] and box[1] <= y <= box[3] for x, y in places)
