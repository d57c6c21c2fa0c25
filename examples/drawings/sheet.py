"""The common look of the drawings: their size, letters, boxes and arrows, and their file.

Each script of this folder writes the SVG file of its own name into the current folder.
"""

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

from colift.benchmark.rendering.style import FAINT, INK, LINE, PAPER, SKY
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

WIDTH: Final = 5.0
"""Width of a drawing [inches]: on a phone its letters are three quarters as large."""

Place = tuple[float, float]

plt.rcParams.update(
    {
        "font.size": 9.0,
        "svg.fonttype": "none",  # Letters, not their outlines.
        "svg.hashsalt": "colift",  # The same bytes each time.
        "text.color": INK,
        "axes.labelcolor": INK,
        "legend.frameon": False,
    }
)


def sheet(width: float, height: float) -> tuple[Figure, Axes]:
    """Return an empty drawing whose unit has the same length in both directions."""
    figure = plt.figure(figsize=(WIDTH, WIDTH * height / width))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, width), ylim=(0.0, height))
    axes.axis("off")
    return figure, axes


def box(
    axes: Axes,
    corner: Place,
    size: Place,
    title: str = "",
    words: str = "",
    *,
    edge: str = LINE,
    ground: str = PAPER,
) -> None:
    """Draw a box from its lower left corner, with a title and words at its upper left."""
    (x, y), (width, height) = corner, size
    shape = FancyBboxPatch(
        corner, width, height, boxstyle="round,pad=0,rounding_size=1.2", facecolor=ground
    )
    shape.set(edgecolor=edge, linewidth=1.2)
    axes.add_patch(shape)
    axes.text(x + 2, y + height - 2, title, weight="bold", va="top")
    axes.text(x + 2, y + height - (6 if title else 2), words, color=INK, va="top", size=8)


def arrow(axes: Axes, start: Place, end: Place, *, colour: str = FAINT, **more: Any) -> None:
    """Draw an arrow; ``more`` are properties of its line."""
    style = {"arrowstyle": "-|>", "color": colour, "shrinkA": 0, "shrinkB": 0, "linewidth": 1.4}
    axes.annotate("", end, start, arrowprops={**style, **more})


def legend(axes: Axes, **more: Any) -> None:
    """Put the names of the curves above the axes, in one line."""
    more = {"ncols": 5, "fontsize": 8.5, "handlelength": 1.6, **more}
    axes.legend(loc="lower left", bbox_to_anchor=(-0.02, 1.0), **more)


def write(figure: Figure, *, ground: Sequence[float] | str = PAPER) -> None:
    """Write the drawing into the current folder, under the name of its script."""
    path = Path(sys.argv[0]).with_suffix(".svg").name
    figure.savefig(path, metadata={"Date": None}, facecolor=ground)


__all__ = ["SKY", "WIDTH", "Place", "arrow", "box", "legend", "plt", "sheet", "write"]
