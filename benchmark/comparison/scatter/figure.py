"""The scatter picture as a figure of matplotlib, for files."""

from collections.abc import Sequence
from typing import Final

from colift.benchmark.comparison.scatter.drawing import Anchor, Colour, draw
from colift.benchmark.comparison.scatter.scale import Box, Place
from colift.benchmark.comparison.scatter.scene import LETTERS, RADIUS, Dot, ScatterScene
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.style import DASHES, FAINT, HUMAN, INK, LINE, PAPER, ROBOT, SKY
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

HIGH: Final = 4.0
HIGH_IN_COLUMN: Final = 3.6
"""Heights of the picture on a page and in a column [inches]."""

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


def scene_size(layout: Layout) -> tuple[int, int]:
    """Return the size of a scene [px] whose letters have those of a layout in its figure."""
    width, height = layout.size(HIGH_IN_COLUMN if layout.narrow else HIGH)
    return round(width * _density(layout)), round(height * _density(layout))


def scatter_figure(scene: ScatterScene, layout: Layout) -> Figure:
    """Return the picture as a figure of matplotlib, its axes in pixels of the scene."""
    width, height = scene.size
    density = _density(layout)
    figure = Figure(figsize=(width / density, height / density), dpi=density, facecolor=PAPER)
    FigureCanvasAgg(figure)
    pen = _FigurePen(figure, width, height, layout.letters / LETTERS)
    draw(scene, pen)
    return figure


def _density(layout: Layout) -> float:
    """Return the pixels of a scene per inch."""
    return 72 * LETTERS / layout.letters


class _FigurePen:
    """Draws on axes that fill a figure."""

    def __init__(self, figure: Figure, width: int, height: int, point: float) -> None:
        self._axes = figure.add_axes((0, 0, 1, 1))
        self._axes.set(xlim=(0, width), ylim=(height, 0))
        self._axes.set_axis_off()
        self._point = point  # Points per pixel of the scene.
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
            lw=width * self._point,
            alpha=opacity,
            ls=DASHES if dashed else "-",
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
            size=size * self._point,
            ha=ALIGNED[anchor],
            va="baseline",
            weight="bold" if bold else "normal",
            style="italic" if italic else "normal",
            rotation=90 if upward else 0,
            rotation_mode="anchor",
            bbox={"facecolor": PAPER, "alpha": 0.75, "linewidth": 0, "pad": 0} if halo else None,
            parse_math=False,
            zorder=self._next(),
        )

    def marker(self, dot: Dot, colour: Colour, *, filled: bool) -> None:
        shape = {"policy": "o", "baseline": "D", "reference": "s"}[dot.point.kind]
        self._axes.plot(
            *dot.at,
            shape,
            ms=2 * RADIUS * self._point,
            mec=COLOURS[colour],
            mfc=COLOURS[colour if filled else "paper"],
            mew=1.7 * self._point,
            zorder=self._next(),
        )

    def _next(self) -> int:
        """Return a drawing order above all before."""
        self._order += 1
        return self._order
