"""Claims and figures of the report, and the common look of the figures."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final

from colift.benchmark.rendering.style import HUMAN, INK, LINE, PAPER, ROBOT, style_axes
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


DPI: Final = 130
WIDTH: Final = 8.0
"""Width of a figure [inches]."""

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
    figure = Figure(
        figsize=(WIDTH, sum(heights) + 0.6), dpi=DPI, facecolor=PAPER, layout="constrained"
    )
    FigureCanvasAgg(figure)
    grid = figure.subplots(
        len(labels),
        columns,
        sharex=share_x,
        sharey="row" if share_y else False,
        squeeze=False,
        height_ratios=list(heights),
    )
    rows: list[list[Axes]] = [list(row) for row in grid]
    for row, label in zip(rows, labels, strict=True):
        for axes in row:
            style_axes(axes)
        row[0].set_ylabel(label, fontsize=9, color=INK)
    for axes in rows[-1]:
        axes.set_xlabel(x_label, fontsize=9, color=INK)
    return figure, rows


def legend(axes: Axes, columns: int = 4) -> None:
    """Put the legend above the axes."""
    axes.legend(
        loc="lower left",
        bbox_to_anchor=(0, 1.0),
        borderaxespad=0.2,
        ncols=columns,
        frameon=False,
        fontsize=8.5,
        labelcolor=INK,
    )


def shade(axes: Axes, spans: Sequence[tuple[float, float]], label: str = "") -> None:
    """Shade spans of the horizontal axis; one of them carries the label."""
    for index, (start, stop) in enumerate(spans):
        axes.axvspan(
            start, stop, color=LINE, alpha=0.45, lw=0, label=label if index == 0 and label else None
        )
