"""The look of the scatter picture, drawn with any pen: that of files or that of pages."""

from collections.abc import Sequence
from typing import Final, Literal, Protocol

from colift.benchmark.comparison.front import FrontPoint
from colift.benchmark.comparison.scatter.scale import Box, Place
from colift.benchmark.comparison.scatter.scene import (
    LETTERS,
    LINE_HEIGHT,
    Dot,
    ScatterScene,
)

Colour = Literal["ink", "faint", "line", "paper", "card", "human", "accent"]
Anchor = Literal["start", "middle", "end"]

RISE: Final = 0.35
"""Height of the middle of letters above their base line, relative to their size."""


class Pen(Protocol):
    """Draws shapes; places are in pixels from the top left."""

    def rectangle(self, box: Box, colour: Colour) -> None:
        """Fill a box."""

    def line(
        self,
        places: Sequence[Place],
        colour: Colour,
        width: float,
        *,
        opacity: float = 1.0,
        dashed: bool = False,
    ) -> None:
        """Draw a line through some places."""

    def text(
        self,
        at: Place,
        text: str,
        colour: Colour,
        size: float,
        *,
        anchor: Anchor = "middle",
        bold: bool = False,
        italic: bool = False,
        upward: bool = False,
        halo: bool = False,
    ) -> None:
        """Write a line of text, with its base line at a place."""

    def marker(self, dot: Dot, colour: Colour, *, filled: bool) -> None:
        """Draw the marker of a dot; its tip is shown if the pen supports that."""


def draw(scene: ScatterScene, pen: Pen) -> None:
    """Draw a scene, from the back to the front."""
    _draw_axes(scene, pen)
    if scene.front:
        pen.line(scene.front, "accent", 1.8, opacity=0.5)
    for dot in scene.dots:
        colour, _ = _colour(dot)
        for bar in dot.bars:
            pen.line((bar[:2], bar[2:]), colour, 1.6, opacity=0.7)
        if dot.label and dot.label.leader:
            leader = dot.label.leader
            pen.line((leader[:2], leader[2:]), "faint", 0.8, opacity=0.7)
    for dot in scene.dots:
        colour, filled = _colour(dot)
        pen.marker(dot, colour, filled=filled)
    for dot in scene.dots:
        _write_name(dot, pen)


def _draw_axes(scene: ScatterScene, pen: Pen) -> None:
    height, (left, top, right, bottom) = scene.size[1], scene.scale.plot
    _, _, beyond, still = scene.scale.inner
    if scene.scale.beyond:
        pen.rectangle((beyond, top, right, bottom), "card")
    if scene.scale.still:
        pen.rectangle((left, still, right, bottom), "card")
    for tick in scene.across:
        pen.line(((tick.at, top), (tick.at, bottom)), "line", 1)
        pen.text((tick.at, bottom + 17), tick.text, "faint", LETTERS)
    for tick in scene.up:
        pen.line(((left, tick.at), (right, tick.at)), "line", 1)
        pen.text((left - 8, tick.at + RISE * LETTERS), tick.text, "faint", LETTERS, anchor="end")
    for tick in scene.ratios:
        pen.text((tick.at, top - 6), tick.text, "human", LETTERS)
    middle = (left + right) / 2
    pen.text((middle, height - 10), scene.axis, "ink", LETTERS)
    pen.text((15, (top + bottom) / 2), scene.axis_up, "ink", LETTERS, upward=True)
    if scene.baseline is not None:
        text = "RMSE divided by that of two people"
        pen.text((middle, top - 25), text, "human", LETTERS)
        ends = ((scene.baseline, top), (scene.baseline, bottom))
        pen.line(ends, "human", 1.5, dashed=True)
    for note in scene.notes:
        x, _, _, base = note.box
        pen.text((x + 4, base - 5), note.text, "faint", LETTERS, anchor="start", italic=True)
    for i, line in enumerate(scene.title):
        at = (14, 23 + 20 * i)
        if i == 0:
            pen.text(at, line, "ink", 16, anchor="start", bold=True)
        else:
            pen.text(at, line, "faint", LETTERS, anchor="start")


def _write_name(dot: Dot, pen: Pen) -> None:
    if dot.label is None:
        return
    left, top, right, bottom = dot.label.box
    point, step = dot.point, LETTERS * LINE_HEIGHT
    first = (top + bottom) / 2 - step * (len(dot.label.lines) - 1) / 2 + RISE * LETTERS
    for i, line in enumerate(dot.label.lines):
        pen.text(
            ((left + right) / 2, first + step * i),
            line,
            _name_colour(point),
            LETTERS,
            bold=dot.best or point.kind == "baseline",
            italic=point.kind == "reference",
            halo=True,
        )


def _name_colour(point: FrontPoint) -> Colour:
    colours: dict[str, Colour] = {"policy": "ink", "baseline": "human", "reference": "faint"}
    return colours[point.kind]


def _colour(dot: Dot) -> tuple[Colour, bool]:
    """Return the colour of a marker, and whether it is filled."""
    if dot.point.kind == "baseline":
        return "human", True
    return ("accent", True) if dot.best else ("faint", False)
