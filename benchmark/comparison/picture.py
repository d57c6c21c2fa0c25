"""Level against smooth, as a picture: every policy a point, and the front of the best."""

import io
import itertools
from collections.abc import Sequence
from typing import Final

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.ticker import MaxNLocator

from ..rendering.style import FAINT, HUMAN, INK, LINE, PAPER, ROBOT, SKY, style_axes
from .comparison import Comparison
from .names import LETTERS, MARKER, write_names
from .scale import Box, Scale, Spot, make_scale, spots

DPI: Final = 130
WIDE: Final = 6.0
"""Width [inches] from which on there is room for more ticks and larger words."""


def comparison_figure(
    comparison: Comparison, *, title: str = "", width: float = 8.0, height: float = 5.6
) -> Figure:
    """Return the picture: mean RMSE against mean SPARC, with 95 % intervals.

    Parameters
    ----------
    comparison
        What it shows.
    title
        What stands above it, on one or more lines, the first in bold.
    width, height
        Its size [inches]; a width of 4 is enough for a telephone.
    """
    drawn = spots(comparison)
    scale = make_scale(drawn)
    figure = _framed(title, width, height)
    axes = figure.add_subplot()
    style_axes(axes)
    axes.set_xlim(scale.x[0], scale.right)
    axes.set_ylim(scale.bottom, scale.y[1])
    across = "RMSE of the height difference [mm]   (← more level)"
    axes.set_xlabel(across, fontsize=LETTERS, color=INK)
    axes.set_ylabel("smoothness: SPARC   (smoother →)", fontsize=LETTERS, color=INK)
    team = comparison.overall.team_rmse_mm.mean
    _draw_ticks(axes, scale, team, wide=width >= WIDE)
    words = _draw_strips(axes, scale, drawn, wide=width >= WIDE)
    stair = _draw_front(axes, scale, [spot for spot in drawn if spot.name in comparison.front])
    for spot in drawn:
        _draw_spot(axes, scale, spot)
    write_names(axes, scale, drawn, [(team, scale.bottom, team, scale.y[1]), *stair], words)
    return figure


def png(figure: Figure) -> bytes:
    """Return the picture as PNG: the same data give the same bytes."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", metadata={"Software": None})
    return buffer.getvalue()


def svg(figure: Figure, salt: str) -> str:
    """Return the picture as an SVG element, its letters as text.

    Parameters
    ----------
    figure
        The picture.
    salt
        Makes its identifiers differ from those of other pictures in the same page.
    """
    buffer = io.StringIO()
    with mpl.rc_context({"svg.fonttype": "none", "svg.hashsalt": salt}):
        figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    text = buffer.getvalue()
    return text[text.index("<svg") :]


def _framed(title: str, width: float, height: float) -> Figure:
    """Return a figure with its title, and margins for one subplot."""
    first, *rest = title.splitlines() or [""]
    head = 0.5 + (0.3 + 0.17 * len(rest) if first else 0.0)
    figure = Figure(figsize=(width, height), dpi=DPI, facecolor=PAPER)
    FigureCanvasAgg(figure)
    figure.subplots_adjust(
        left=0.66 / width, right=1 - 0.1 / width, bottom=0.52 / height, top=1 - head / height
    )
    left = 0.1 / width
    figure.text(left, 1 - 0.08 / height, first, fontsize=12, weight="bold", color=INK, va="top")
    figure.text(left, 1 - 0.33 / height, "\n".join(rest), fontsize=LETTERS, color=FAINT, va="top")
    return figure


def _draw_ticks(axes: Axes, scale: Scale, team: float, *, wide: bool) -> None:
    """Draw ticks on the scale only; above, in multiples of the human-human team."""
    axes.set_xticks(_ticks(*scale.x, 9 if wide else 6))
    axes.set_yticks(_ticks(*scale.y, 8))
    above = axes.secondary_xaxis(
        "top", functions=(lambda mm: np.divide(mm, team), lambda times: np.multiply(times, team))
    )
    ratios = _ticks(scale.x[0] / team, scale.x[1] / team, 7 if wide else 4)
    above.set_xticks(ratios, [f"{ratio:g}\N{MULTIPLICATION SIGN}" for ratio in ratios])
    above.tick_params(labelsize=LETTERS - 0.5, colors=HUMAN, length=0, pad=1)
    told = "RMSE over the human-human team's"
    above.set_xlabel(told, fontsize=LETTERS - 0.5, color=HUMAN, labelpad=5)
    above.spines["top"].set_visible(False)
    axes.axvline(team, color=HUMAN, lw=1.2, ls=(0, (4, 3)), zorder=1.5)


def _ticks(low: float, high: float, count: int) -> list[float]:
    places = MaxNLocator(count, steps=[1, 2, 5, 10]).tick_values(low, high)
    return [float(place) for place in places if low <= place <= high]


def _draw_strips(axes: Axes, scale: Scale, drawn: Sequence[Spot], *, wide: bool) -> list[Text]:
    """Draw the strips for what is off the scale, and return the words that explain them."""
    words = []

    def write(x: float, y: float, told: str, ha: str, va: str) -> None:
        size = LETTERS - (1.0 if wide else 2.5)
        words.append(axes.text(x, y, told, ha=ha, va=va, size=size, color=FAINT, style="italic"))

    if scale.beyond:
        axes.axvspan(scale.x[1], scale.right, color=SKY, lw=0, zorder=0.4)
        axes.axvline(scale.x[1], color=LINE, lw=1)
        write(scale.right, scale.y[1], "off the scale ", "right", "top")
    if scale.still:
        axes.axhspan(scale.bottom, scale.y[0], color=SKY, lw=0, zorder=0.4)
        axes.axhline(scale.y[0], color=LINE, lw=1)
        middle = (scale.y[0] + scale.bottom) / 2
        write(scale.x[0], middle, " does not move along: no smoothness", "left", "center")
    if any(spot.missing for spot in drawn):
        write(scale.x[0], scale.y[0], " * without smoothness in some lifts", "left", "bottom")
    return words


def _draw_front(axes: Axes, scale: Scale, front: Sequence[Spot]) -> list[Box]:
    """Draw the front as a stair, and return its pieces."""
    places = [scale.place(spot) for spot in front]
    corners = places[:1]
    for (_, y), (next_x, next_y) in itertools.pairwise(places):
        corners += [(next_x, y), (next_x, next_y)]
    axes.plot(*zip(*corners, strict=True), color=ROBOT, lw=1.6, alpha=0.55, zorder=1.8)
    return [
        (min(x, u), min(y, v), max(x, u), max(y, v))
        for (x, y), (u, v) in itertools.pairwise(corners)
    ]


def _draw_spot(axes: Axes, scale: Scale, spot: Spot) -> None:
    x, y = scale.place(spot)
    for left, low, right, high in scale.bars(spot):
        axes.plot([left, right], [low, high], color=spot.colour, lw=1.4, zorder=2.5)
    inside = spot.colour if spot.filled else PAPER
    axes.plot(x, y, spot.marker, ms=MARKER, mec=spot.colour, mew=1.5, mfc=inside, zorder=3)
