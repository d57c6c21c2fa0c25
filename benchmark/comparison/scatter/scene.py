"""All that the scatter picture shows, in pixels from the top left."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np
from colift.benchmark.comparison.front import FrontPoint, pareto_front
from colift.benchmark.comparison.scatter.scale import Box, Place, Scale, make_scale
from colift.benchmark.episode.metric import Metric
from colift.benchmark.rendering.labels import nearest, place_labels
from colift.benchmark.rendering.ticks import round_ticks
from colift.benchmark.statistics import Interval

WIDE: Final = (920, 520)
NARROW: Final = (390, 440)
"""Sizes of the picture [px], for a screen and for a telephone."""
ROOMY: Final = 600
"""Width from which there is room for more ticks and longer notes [px]."""

MARGINS: Final = (56, 44, 12, 48)
"""Room for axes at the left, at the top, at the right and below the plot [px]."""
TITLE_LINE: Final = 20
TITLE_GAP: Final = 12
"""Room for a line of the title, and below its last [px]."""

TICK_DIGITS: Final = 3
"""Digits of whole numbers at the left for which there is room."""
TICK_DIGIT: Final = 8
"""Width of one more digit [px]."""

LETTERS: Final = 12.0
"""Size of letters [px]."""
LINE_HEIGHT: Final = 1.2
"""Distance between the lines of a text, relative to the size of its letters."""
RADIUS: Final = 5.0
"""Radius of a marker [px]."""
CLEAR: Final = 2.0
"""Room left free around names and markers [px]."""

NAMED: Final = 40
"""Most points that get a name: the baseline, the front, the references, then the rest by error."""


@dataclass(frozen=True, kw_only=True)
class Tick:
    """A tick of an axis."""

    at: float
    """Pixels from the left or from the top."""
    text: str


@dataclass(frozen=True, kw_only=True)
class Note:
    """A few words in the plot."""

    box: Box
    text: str


@dataclass(frozen=True, kw_only=True)
class Label:
    """The name of a point, in the middle of a box."""

    box: Box
    lines: tuple[str, ...]
    leader: Box | None
    """Line from the marker to a name away from it."""


@dataclass(frozen=True, kw_only=True)
class Dot:
    """A point, its intervals and its name."""

    point: FrontPoint
    at: Place
    bars: tuple[Box, ...]
    best: bool
    """Whether the point is on the front."""
    tip: str
    """Description of the point."""
    label: Label | None
    """None if there is no room for its name."""


@dataclass(frozen=True, kw_only=True)
class ScatterScene:
    """The picture: error across, another metric up, both better towards the top left."""

    size: tuple[int, int]
    """Width and height [px]."""
    title: tuple[str, ...]
    """Lines above the plot, the first in bold."""
    axis: str
    """Name of the error's axis."""
    axis_up: str
    """Name of the other metric's axis."""
    scale: Scale
    across: tuple[Tick, ...]
    """RMSE [mm]."""
    up: tuple[Tick, ...]
    """The other metric."""
    ratios: tuple[Tick, ...]
    """RMSE over that of the human-human baseline, above the plot; none without it."""
    baseline: float | None
    """The human-human baseline's RMSE [px from the left]."""
    front: tuple[Place, ...]
    """Corners of the line that joins the front."""
    notes: tuple[Note, ...]
    dots: tuple[Dot, ...]
    """The points, in the order given."""
    summary: str
    """The picture in a sentence."""


def make_scene(
    points: Sequence[FrontPoint],
    axes: tuple[Metric, Metric],
    *,
    axis: str,
    size: tuple[int, int] = WIDE,
    title: Sequence[str] = (),
) -> ScatterScene:
    """Return the scene.

    Parameters
    ----------
    points
        At least one policy, the best first; the human-human baseline and the references.
    axes
        The error, and the other metric of the points.
    axis
        Name of the error's axis.
    size
        Width and height [px].
    title
        Lines above the plot.
    """
    (width, height), (left, top, right, bottom) = size, MARGINS
    top += TITLE_LINE * len(title) + (TITLE_GAP if title else 0)
    _, second = axes
    scale = make_scale(points, (left, top, width - right, height - bottom), second)
    up = _ticks(scale.down, (min(scale.y), max(scale.y)), 7)
    longest = max((len(tick.text.partition(".")[0]) for tick in up), default=0)
    if longest > TICK_DIGITS:
        left += TICK_DIGIT * (longest - TICK_DIGITS)
        scale = make_scale(points, (left, top, width - right, height - bottom), second)
        up = _ticks(scale.down, (min(scale.y), max(scale.y)), 7)
    wide, front = width >= ROOMY, pareto_front(points, second)
    baseline = next((point.rmse_mm.mean for point in points if point.kind == "baseline"), None)
    corners = _stair([scale.place(point) for point in front])
    notes = _notes(scale, points, second, wide)
    lines = [_span(*ends) for ends in pairwise(corners)]
    if baseline is not None:
        across = scale.across(baseline)
        lines.append((across, scale.plot[1], across, scale.plot[3]))
    return ScatterScene(
        size=size,
        title=tuple(title),
        axis=axis,
        axis_up=f"{second.axis} · {second.words.praise[1]} →",
        scale=scale,
        across=_ticks(scale.across, scale.x, 10 if wide else 6),
        up=up,
        ratios=() if baseline is None else _ratios(scale, baseline, 8 if wide else 4),
        baseline=None if baseline is None else scale.across(baseline),
        front=corners,
        notes=notes,
        dots=_dots(points, front, second, scale, notes, lines),
        summary=_summary(points, front, axes),
    )


def minus(text: str) -> str:
    """Return a number with a true minus sign."""
    return text.replace("-", "\N{MINUS SIGN}")


def text_width(text: str, size: float, *, bold: bool = False) -> float:
    """Return an approximate upper bound of the width of a line of text [px], in the usual fonts."""
    ems = (0.42 if c in "ijltrfI.,:;'()|-* " else 0.98 if c in "mwMW@%" else 0.65 for c in text)
    return size * (1.13 if bold else 1.0) * sum(ems)


def _ticks(place: Callable[[float], float], ends: Interval, most: int) -> tuple[Tick, ...]:
    """Return the round numbers between two ends, all with equally many decimals."""
    values = round_ticks(*ends, most)
    digits = max((len(f"{value:g}".partition(".")[2]) for value in values), default=0)
    return tuple(Tick(at=place(value), text=minus(f"{value:.{digits}f}")) for value in values)


def _ratios(scale: Scale, baseline: float, most: int) -> tuple[Tick, ...]:
    return tuple(
        Tick(at=scale.across(ratio * baseline), text=f"{ratio:g}\N{MULTIPLICATION SIGN}")
        for ratio in round_ticks(scale.x[0] / baseline, scale.x[1] / baseline, most)
    )


def _dots(
    points: Sequence[FrontPoint],
    front: Sequence[FrontPoint],
    metric: Metric,
    scale: Scale,
    notes: Sequence[Note],
    lines: Sequence[Box],
) -> tuple[Dot, ...]:
    """Return the points with their names, where there is room."""
    places = [scale.place(point) for point in points]
    order = sorted(
        range(len(points)),
        key=lambda i: (
            points[i].kind != "baseline",
            points[i] not in front,
            points[i].kind == "policy",
            points[i].rmse_mm.mean,
        ),
    )[:NAMED]
    texts = [_name(points[i], metric, scale) for i in order]
    bold = [i for i in order if points[i] in front or points[i].kind == "baseline"]
    half = RADIUS + CLEAR
    boxes = place_labels(
        [places[i] for i in order],
        [
            (
                max(text_width(line, LETTERS, bold=i in bold) for line in text) + 2 * CLEAR,
                LETTERS * LINE_HEIGHT * len(text),
            )
            for i, text in zip(order, texts, strict=True)
        ],
        obstacles=[(x - half, y - half, x + half, y + half) for x, y in places]
        + [note.box for note in notes],
        lines=[
            (left - 1, top - 1, right + 1, bottom + 1)
            for left, top, right, bottom in (*lines, *(b for p in points for b in scale.bars(p)))
        ],
        bounds=scale.plot,
    )
    labels = {
        i: _label(places[i], text, tuple(box.tolist()))
        for i, text, box in zip(order, texts, boxes, strict=True)
        if box is not None
    }
    return tuple(
        Dot(
            point=point,
            at=places[i],
            bars=scale.bars(point),
            best=point in front,
            tip=_tip(point, metric),
            label=labels.get(i),
        )
        for i, point in enumerate(points)
    )


def _label(at: Place, lines: tuple[str, ...], box: Box) -> Label:
    x, y = (float(each) for each in nearest(np.array(box), at))
    away = math.hypot(x - at[0], y - at[1]) > 2.6 * RADIUS
    return Label(box=box, lines=lines, leader=(*at, x, y) if away else None)


def _name(point: FrontPoint, metric: Metric, scale: Scale) -> tuple[str, ...]:
    """Return the name of a point, with a line of the values that its place does not show."""
    values = [f"{point.rmse_mm.mean:.0f} mm"] if scale.off(point) else []
    if point.second is not None and scale.below(point):
        values.append(_value(metric, point.second.mean, max(metric.digits - 1, 0)))
    name = f"{point.name} *" if point.second and point.missing else point.name
    return (name, ", ".join(values)) if values else (name,)


def _tip(point: FrontPoint, metric: Metric) -> str:
    second = f"no {metric.noun}"
    if point.second:
        second = _value(metric, point.second.mean, metric.digits)
    return f"{point.name}: RMSE {point.rmse_mm.mean:.1f} mm, {second}"


def _value(metric: Metric, value: float, places: int) -> str:
    """Return a value of a metric with its symbol and unit."""
    return f"{metric.symbol} {minus(f'{value:.{places}f}')} {metric.unit}".rstrip()


def _stair(places: Sequence[Place]) -> tuple[Place, ...]:
    """Return the corners of the line that joins the places of the front."""
    corners = list(places[:1])
    for (_, y), (x, next_y) in pairwise(places):
        corners += [(x, y), (x, next_y)]
    return tuple(corners)


def _span(one: Place, other: Place) -> Box:
    """Return the box of a line that is straight up or across."""
    (left, right), (top, bottom) = (sorted(ends) for ends in zip(one, other, strict=True))
    return left, top, right, bottom


def _notes(
    scale: Scale, points: Sequence[FrontPoint], metric: Metric, wide: bool
) -> tuple[Note, ...]:
    """Return the notes that explain the strips and the asterisk."""
    left, top, right, bottom = scale.plot
    floor, height = scale.inner[3], LETTERS * LINE_HEIGHT + CLEAR
    texts = []
    if scale.beyond:
        text = "off the scale" if wide else "beyond"
        texts.append((text, right - text_width(text, LETTERS) - CLEAR, top + CLEAR))
    if scale.still:
        why = f"{metric.words.absent}: " if wide and metric.words.absent else ""
        text = f"{why}no {metric.noun}"
        texts.append((text, left + CLEAR, bottom - height))
    if any(point.second and point.missing for point in points):
        texts.append((f"* without {metric.noun} in some lifts", left + CLEAR, floor - height))
    return tuple(
        Note(text=text, box=(x, y, x + text_width(text, LETTERS), y + height))
        for text, x, y in texts
    )


def _summary(
    points: Sequence[FrontPoint], front: Sequence[FrontPoint], axes: tuple[Metric, Metric]
) -> str:
    leading, second = axes
    policies = sum(point.kind == "policy" for point in points)
    best = ", ".join(point.name for point in front) or "none"
    return (
        f"{policies} policies by {leading.symbol} (across, further left is "
        f"{leading.words.praise[1]}) and {second.noun} (up, higher is {second.words.praise[1]}). "
        f"Not beaten in both by any other: {best}."
    )
