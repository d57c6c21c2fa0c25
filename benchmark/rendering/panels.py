"""Figures of several panels, for any layout, and their legends."""

from collections.abc import Mapping, Sequence
from typing import Final

from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.style import DASHES, HUMAN, LOOKS, PEOPLE, style_axes
from colift.benchmark.statistics import Estimate
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

NARROW: Final = 0.7
"""Heights of panels in a column of print, relative to those on a page."""

AROUND: Final = 0.6
"""Room for axes and legend [inches]."""

APART: Final = 0.05
"""Distance of the intervals of two lines, where the distance of their points is 1."""

FULL: Final = 0.9
"""Largest width of a legend, relative to that of its panel."""


def panels(
    layout: Layout,
    labels: Sequence[str],
    heights: Sequence[float],
    *,
    columns: int = 1,
    x_label: str = "",
    share_x: bool = True,
    share_y: bool = True,
) -> tuple[Figure, list[list[Axes]]]:
    """Return a figure of stacked panels in the common look.

    Parameters
    ----------
    layout
        Size of the figure. In a narrow one, the columns of panels stand below each other.
    labels
        Quantity on the vertical axis of each row of panels.
    heights
        Height of each row [inches].
    columns
        Panels in a row.
    x_label
        Quantity on the horizontal axes.
    share_x
        Whether all panels share the horizontal axis.
    share_y
        Whether the panels of a row share the vertical axis.
    """
    across = 1 if layout.narrow else columns
    height = (NARROW if layout.narrow else 1.0) * sum(heights) * columns / across
    figure = Figure(figsize=layout.size(height + AROUND), layout="constrained")
    FigureCanvasAgg(figure)
    stacks = columns // across
    grid = figure.subplots(
        stacks * len(labels), across, squeeze=False, height_ratios=[*heights] * stacks
    )
    rows = [grid[row :: len(labels)].ravel().tolist() for row in range(len(labels))]
    for row, label in zip(rows, labels, strict=True):
        for index, axes in enumerate(row):
            style_axes(axes)
            if share_x:
                if axes is not rows[0][0]:
                    axes.sharex(rows[0][0])
                axes.tick_params(labelbottom=row is rows[-1])
            if share_y and index:
                axes.sharey(row[0])
            if index % across == 0:
                _label(axes, label, upright=layout.height is not None)
            elif share_y:
                axes.tick_params(labelleft=False)
    for axes in rows[-1]:
        axes.set_xlabel(x_label)
    return figure, rows


def _label(axes: Axes, label: str, *, upright: bool) -> None:
    """Write the quantity beside an axis, upright on a slide, whose panels may be low."""
    if upright:
        axes.set_ylabel(label.replace(" [", "\n["), rotation=0, ha="right", va="center")
    else:
        axes.set_ylabel(label)


def legend(axes: Axes, title: str = "") -> None:
    """Put the legend above the axes, with a title above it, in as few rows as its width allows."""
    figure = axes.get_figure()
    specification = axes.get_subplotspec()
    assert figure is not None
    assert specification is not None
    beside = axes.yaxis.get_tightbbox()
    room = figure.bbox.width / specification.get_gridspec().ncols - (beside.width if beside else 0)
    for columns in range(4, 0, -1):
        made = axes.legend(
            loc="lower left",
            bbox_to_anchor=(0, 1.0),
            borderaxespad=0.2,
            ncols=columns,
            title=title,
            alignment="left",
        )
        if made.get_window_extent().width <= FULL * room:
            return


def shared_legend(axes: Axes) -> None:
    """Put the legend of all panels above them, in as few rows as the figure's width allows."""
    figure = axes.get_figure()
    assert isinstance(figure, Figure)
    for columns in range(6, 0, -1):
        made = figure.legend(
            *axes.get_legend_handles_labels(), loc="outside upper left", ncols=columns
        )
        if columns == 1 or made.get_window_extent().width <= FULL * figure.bbox.width:
            return
        made.remove()


def draw_lines(axes: Axes, lines: Mapping[str, Sequence[tuple[float, float]]]) -> None:
    """Draw a line through some points for each name, with its colour, line style and marker."""
    for i, (name, points) in enumerate(lines.items()):
        again, which = divmod(i, len(LOOKS))
        colour, line, _ = LOOKS[which]
        *_, marker = LOOKS[(which + again) % len(LOOKS)]
        x, y = zip(*sorted(points), strict=True)
        axes.plot(x, y, color=colour, ls=line, marker=marker, ms=4, lw=1.6, label=name)


def draw_estimates(axes: Axes, lines: Mapping[str, Sequence[tuple[float, Estimate]]]) -> None:
    """Draw lines as :func:`draw_lines` does, with 95 % intervals, which do not hide each other."""
    beside = [APART * (i - (len(lines) - 1) / 2) for i in range(len(lines))]
    draw_lines(
        axes,
        {
            name: [(place + x, each.mean) for place, each in line]
            for x, (name, line) in zip(beside, lines.items(), strict=True)
        },
    )
    for drawn, line in zip(axes.get_lines(), lines.values(), strict=True):
        low, high = zip(*(each.ends for _, each in line), strict=True)
        axes.vlines(drawn.get_xdata(), low, high, color=drawn.get_color(), lw=1.0)


def draw_people(axes: Axes, error: float) -> None:
    """Draw a line at the error of two people."""
    axes.axhline(error, color=HUMAN, lw=1.4, ls=DASHES, label=PEOPLE)
