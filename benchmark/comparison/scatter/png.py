"""The scatter picture as PNG, by matplotlib."""

import io
from collections.abc import Sequence
from typing import Final

from colift.benchmark.comparison.scatter.drawing import Anchor, Colour, draw
from colift.benchmark.comparison.scatter.scale import Box, Place
from colift.benchmark.comparison.scatter.scene import RADIUS, Dot, ScatterScene
from colift.benchmark.rendering.style import FAINT, HUMAN, INK, LINE, PAPER, ROBOT, SKY
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

PIXELS: Final = 1.6
"""Pixels of the file per pixel of the scene."""

POINT: Final = 0.72
"""Points per pixel of the scene, at 100 pixels per inch."""

COLOURS: Final[dict[Colour, str]] = {
    "ink": INK,
    "faint": FAINT,
    "line": LINE,
    "paper": PAPER,
    "card": SKY,
    "human": HUMAN,
    "accent": ROBOT,
}
ALIGNED: Final[dict[Anchor, str]] = {"start": "left", "middle": "center", "end": "right"}


def png(scene: ScatterScene) -> bytes:
    """Return the picture as PNG: the same scene gives the same bytes."""
    buffer = io.BytesIO()
    figure = scatter_figure(scene)
    figure.savefig(buffer, format="png", dpi=100 * PIXELS, metadata={"Software": None})
    return buffer.getvalue()


def scatter_figure(scene: ScatterScene) -> Figure:
    """Return the picture as a figure of matplotlib, its axes in pixels of the scene."""
    width, height = scene.size
    figure = Figure(figsize=(width / 100, height / 100), dpi=100, facecolor=PAPER)
    FigureCanvasAgg(figure)
    pen = _FigurePen(figure, width, height)
    draw(scene, pen)
    return figure


class _FigurePen:
    """Draws on axes that fill a figure."""

    def __init__(self, figure: Figure, width: int, height: int) -> None:
        self._axes = figure.add_axes((0, 0, 1, 1))
        self._axes.set(xlim=(0, width), ylim=(height, 0))
        self._axes.set_axis_off()
        self._order = 0

    def rectangle(self, box: Box, colour: Colour) -> None:
        left, top, right, bottom = box
        self._axes.fill(
            (left, right, right, left),
            (top, top, bottom, bottom),
            color=COLOURS[colour],
            lw=0,
            zorder=self._next(),
        )

    def line(
        self,
        places: Sequence[Place],
        colour: Colour,
        width: float,
        *,
        opacity: float = 1.0,
        dashed: bool = False,
    ) -> None:
        self._axes.plot(
            *zip(*places, strict=True),
            color=COLOURS[colour],
            lw=width * POINT,
            alpha=opacity,
            ls=(0, (4, 3)) if dashed else "-",
            zorder=self._next(),
        )

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
        self._axes.text(
            *at,
            text,
            color=COLOURS[colour],
            size=size * POINT,
            ha=ALIGNED[anchor],
            va="baseline",
            weight="bold" if bold else "normal",
            style="italic" if italic else "normal",
            rotation=90 if upward else 0,
            rotation_mode="anchor",
            path_effects=[withStroke(linewidth=3 * POINT, foreground=PAPER)] if halo else None,
            parse_math=False,
            zorder=self._next(),
        )

    def marker(self, dot: Dot, colour: Colour, *, filled: bool) -> None:
        shape = {"policy": "o", "baseline": "D", "reference": "s"}[dot.point.kind]
        self._axes.plot(
            *dot.at,
            shape,
            ms=2 * RADIUS * POINT,
            mec=COLOURS[colour],
            mfc=COLOURS[colour if filled else "paper"],
            mew=1.7 * POINT,
            zorder=self._next(),
        )

    def _next(self) -> int:
        """Return a drawing order above all before."""
        self._order += 1
        return self._order
