"""Claims and figures of the report, and the common look of the figures."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final

from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.style import HUMAN, LINE, ROBOT, style_axes
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

OUTSIDE = "The measured value lies outside the criterion."


@dataclass(frozen=True, kw_only=True)
class Claim:
    """A statement of the paper with a measured answer."""

    claim: str
    """The statement, in words."""
    figure: str
    """The report's figure or table with the evidence."""
    paper: str
    """The paper's result."""
    criterion: str
    """Condition under which it holds."""
    measured: str
    """Our result, in words and numbers."""
    values: Mapping[str, float | None] = field(default_factory=dict)
    """The numbers of ``measured``, units in the names."""
    holds: bool
    fitted: bool = False
    """Whether numbers of the set-up were fitted to it, so that it is no independent finding."""
    note: str = ""
    """Reasons in the data, or limits of the answer; never empty if the claim does not hold."""

    def __post_init__(self) -> None:
        """Give a claim that does not hold a note, if it has none."""
        if not self.holds and not self.note:
            object.__setattr__(self, "note", OUTSIDE)


def p_value_text(p: float) -> str:
    """Return a p value as text; its floor is the number of resamples."""
    return f"p = {p:.4f}" if p >= 0.00015 else "p < 0.0002"


NARROW: Final = 0.7
"""Heights of panels in a column of print, relative to those on a page."""

AROUND: Final = 0.6
"""Room for axes and legend [inches]."""

FULL: Final = 0.9
"""Largest width of a legend, relative to that of its panel."""

PREDICTION: Final = "#009E73"
CONFIDENCE: Final = "#8A4F9E"
"""Colour of the confidence, distinguishable from those of the two ends with any kind of colour
vision."""

COLOURS: Final = {"human": HUMAN, "robot": ROBOT}


@dataclass(frozen=True, kw_only=True, eq=False)
class Exhibit:
    """A figure of the report."""

    name: str
    """Name of its files, such as ``figure-4``."""
    title: str
    caption: str
    """Content of the figure, and the point to note."""
    figure: Figure
    columns: Mapping[str, Sequence[float | str] | Sequence[float]]
    """The data, column by column, units in the names."""


def panels(
    layout: Layout,
    labels: Sequence[str],
    heights: Sequence[float],
    *,
    columns: int = 1,
    x_label: str = "time step (100 ms)",
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
                axes.sharex(rows[0][0])
                axes.tick_params(labelbottom=row is rows[-1])
            if share_y:
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


def shade(axes: Axes, spans: Sequence[tuple[float, float]], label: str = "") -> None:
    """Shade spans of the horizontal axis; one of them carries the label."""
    for index, (start, stop) in enumerate(spans):
        axes.axvspan(
            start, stop, color=LINE, alpha=0.45, lw=0, label=label if index == 0 and label else None
        )
