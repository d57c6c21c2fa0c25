"""The chart of a lift: heights over time, with hurdles; and places on the table below."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.episode.drawn import (
    DrawnHurdle,
    DrawnSeries,
    ball_and_target,
    drawn_heights,
    drawn_hurdles,
    intended_far_end,
)
from colift.benchmark.episode.trace import Trace
from colift.benchmark.rendering.style import (
    AIM,
    COLOURS,
    DASHES,
    FAINT,
    HUMAN,
    INK,
    LINE,
    PAPER,
    ROBOT,
    ROBOT_DASHES,
)
from matplotlib.artist import Artist
from matplotlib.figure import Figure, SubFigure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LETTERS: Final = 8.5
"""Size of letters at scale 1 [points]."""

GAP: Final = 0.28
"""Opacity of the area of an error."""

WINDOW: Final = 0.22
"""Opacity of a hurdle's bar outside the nearest stay."""

BAR: Final = 0.022
"""Height of a hurdle's bar, as a share of the axis."""

ROOM: Final = 0.09
"""Room above and below the curves for the words on a hurdle, as a share of their range."""

STRIP: Final = 30
ROW: Final = 15
"""Room for a legend of one row, and for each further row [1/100 inch at scale 1]."""

PLACES: Final = 0.6
"""Height of the axis of places, relative to that of heights."""


@dataclass(frozen=True, kw_only=True)
class Pen:
    """The size and the strength of everything that is drawn."""

    scale: float
    """Size of letters and lines; 1 suits a picture 640 pixels wide."""
    opacity: float = 1.0
    rows: int = 0
    """Rows of each legend in print; 0 for one row, whose letters shrink where there is no room."""

    @property
    def strip(self) -> float:
        """Room above an axis for its legend [1/100 inch]."""
        return (STRIP + ROW * max(self.rows - 1, 0)) * self.scale

    @property
    def letters(self) -> float:
        """Size of letters [points]."""
        return LETTERS * self.scale


SHRINKING: Final = ((1.0, 1.8), (1.0, 1.1), (0.9, 1.1), (0.8, 0.9), (0.7, 0.8))
"""Sizes of the letters of a legend, and distances of its columns, as they are tried."""


class Chart:
    """The curves of a lift, for a figure of any size.

    Parameters
    ----------
    trace
        The lift; at least one frame.
    partner
        Name of the holder of the far end, for the legend.
    drawn
        What the task shows besides.
    """

    def __init__(self, trace: Trace, *, partner: str, drawn: Sequence[DrawnSeries] = ()) -> None:
        self._trace = trace
        self._partner = partner
        self._drawn = drawn
        self._hurdles = drawn_hurdles(drawn, trace)
        self._rolling = ball_and_target(drawn)
        self.times = np.arange(1, len(trace.human_end) + 1, dtype=np.float64) * FRAME
        """End of each frame [s]."""

    @property
    def panels(self) -> int:
        """Number of axes below each other."""
        return 1 if self._rolling is None else 2

    def curves(self) -> list[list[tuple[NDArray[np.float64], str]]]:
        """Return the curves with a dot at the cursor, and their colours, panel by panel [mm]."""
        trace = self._trace
        found = [[(1000 * trace.human_end, HUMAN), (1000 * trace.robot_end, ROBOT)]]
        if self._rolling is not None:
            found.append([(1000 * trace.added[self._rolling[0].name], INK)])
        return found

    def draw(
        self, figure: Figure | SubFigure, pen: Pen, moments: Sequence[int] = ()
    ) -> "list[Axes]":
        """Draw all axes into a figure, whose size is that of the chart, and return them.

        There is a line at each of the moments, which are frames.
        """
        width, height = (
            100 * float(size) / figure.dpi for size in (figure.bbox.width, figure.bbox.height)
        )
        strip, ratios = pen.strip, [1.0, PLACES][: self.panels]
        axes = list(
            figure.subplots(
                self.panels, 1, sharex=True, squeeze=False, gridspec_kw={"height_ratios": ratios}
            )[:, 0]
        )
        low, high = 42 * pen.scale, height - strip
        mean = (high - low - strip * (self.panels - 1)) / self.panels
        figure.subplots_adjust(
            left=58 * pen.scale / width,
            right=1 - 18 * pen.scale / width,
            bottom=low / height,
            top=high / height,
            hspace=strip / mean,
        )
        axes[0].set_xlim(0, float(self.times[-1]))
        self._heights(axes[0], pen)
        if self._rolling is not None:
            self._places(axes[1], pen, *self._rolling)
        for panel, curves in zip(axes, self.curves(), strict=True):
            for time, frame in zip(self.times[list(moments)], moments, strict=True):
                panel.axvline(time, color=INK, lw=0.72 * pen.scale, zorder=5)
                for values, colour in curves:
                    panel.plot(
                        time, values[frame], "o", ms=6.5 * pen.scale, mfc=colour, mec=PAPER,
                        mew=0.8 * pen.scale, clip_on=False, zorder=5.5,
                    )  # fmt: skip
        axes[-1].set_xlabel("time [s]", fontsize=pen.letters, color=INK, labelpad=2 * pen.scale)
        return axes

    def _heights(self, axes: "Axes", pen: Pen) -> None:
        (human, _), (robot, _) = self.curves()[0]
        target = 1000 * self._trace.target
        goal = intended_far_end(self._drawn)
        keys: list[Artist] = [
            self._line(axes, pen, human, "human's end", HUMAN, 2.2),
            self._line(
                axes,
                pen,
                robot,
                f"{self._partner}'s end",
                ROBOT,
                2.2,
                ROBOT_DASHES if pen.rows else "-",
            ),
        ]
        every = [human, robot, target]
        if self._rolling is None:
            meant, gap = (
                (human, "difference")
                if goal is None
                else (1000 * self._trace.added[goal.name], "error")
            )
            keys.append(self._area(axes, pen, meant, robot, gap))
        keys.append(self._line(axes, pen, target, "human's intention", INK, 0.9, DASHES))
        for each in drawn_heights(self._drawn):
            values = 1000 * self._trace.added[each.name]
            keys.append(self._line(axes, pen, values, each.label, COLOURS[each.where], 1.2, DASHES))
            every.append(values)
        bars = [np.array([1000 * each.height]) for each in self._hurdles]
        low, high = _range([*every, *bars], least=20.0)
        room = ROOM * (high - low) if bars else 0.0
        axes.set_ylim(low - room, high + room)
        for hurdle in self._hurdles:
            self._bar(axes, pen, hurdle)
        self._style(axes, pen, "height [mm]", keys)

    def _places(self, axes: "Axes", pen: Pen, ball: DrawnSeries, target: DrawnSeries) -> None:
        place, goal = (1000 * self._trace.added[each.name] for each in (ball, target))
        axes.set_ylim(*_range([place, goal], least=100.0))
        keys: list[Artist] = [
            self._line(axes, pen, place, f"{ball.label}, towards the {self._partner}", INK, 2.2),
            self._line(axes, pen, goal, target.label, AIM, 1.2, DASHES),
            self._area(axes, pen, goal, place, "error"),
        ]
        self._style(axes, pen, "place [mm]", keys)

    def _line(
        self,
        axes: "Axes",
        pen: Pen,
        values: NDArray[np.float64],
        label: str,
        colour: str,
        width: float,
        style: str | tuple[int, tuple[float, ...]] = "-",
    ) -> Artist:
        """Draw a curve, and return its key: in full strength, whatever that of the curve."""
        thick = width * pen.scale
        axes.plot(
            self.times,
            values,
            color=colour,
            lw=thick,
            ls=style,
            alpha=pen.opacity,
            zorder=width + 1,
        )
        return Line2D([], [], color=colour, lw=thick, ls=style, label=label)

    def _area(
        self,
        axes: "Axes",
        pen: Pen,
        one: NDArray[np.float64],
        other: NDArray[np.float64],
        label: str,
    ) -> Artist:
        axes.fill_between(
            self.times, one, other, color=FAINT, alpha=GAP * pen.opacity, linewidth=0, zorder=1
        )
        return Patch(color=FAINT, alpha=GAP, lw=0, label=label)

    def _bar(self, axes: "Axes", pen: Pen, hurdle: DrawnHurdle) -> None:
        """Draw a hurdle: a bar over its window, full in the nearest stay, and what is missed."""
        colour, height = COLOURS[hurdle.where], 1000 * hurdle.height
        low, high = axes.get_ylim()
        thick = BAR * (high - low)

        def bar(start: int, stop: int, opacity: float) -> None:
            corner = start * FRAME, height - thick / 2
            axes.add_patch(
                Rectangle(
                    corner,
                    (stop - start) * FRAME,
                    thick,
                    facecolor=(colour, opacity * pen.opacity),
                    edgecolor=(colour, pen.opacity),
                    lw=0.9 * pen.scale,
                    zorder=4,
                )
            )

        bar(hurdle.start, hurdle.stop, WINDOW)
        words = f"{hurdle.label} not reached"
        if hurdle.nearest is not None and hurdle.missed is not None:
            bar(hurdle.nearest, hurdle.nearest + hurdle.stay, 1.0)
            stay = slice(hurdle.nearest, hurdle.nearest + hurdle.stay)
            there = [float(end[stay].mean()) for end, _ in self.curves()[0]]
            middle = [float(self.times[stay].mean())] * 3
            heights = min(height, *there), height, max(height, *there)
            axes.plot(
                middle, heights, color=colour, alpha=pen.opacity, lw=1.6 * pen.scale, zorder=4
            )
            words = f"{hurdle.label} missed by {1000 * hurdle.missed:.0f} mm"
        above = self._outermost(hurdle)
        centre = (hurdle.start + hurdle.stop) / 2 * FRAME
        axes.annotate(
            words,
            (centre, height + (thick / 2 if above else -thick / 2)),
            (0, 2 * pen.scale if above else -2 * pen.scale),
            textcoords="offset points",
            ha="center",
            va="bottom" if above else "top",
            fontsize=pen.letters,
            color=colour,
            alpha=pen.opacity,
            zorder=6,
            bbox={"facecolor": PAPER, "alpha": 0.75 * pen.opacity, "linewidth": 0, "pad": 0.5},
        )

    def _outermost(self, hurdle: DrawnHurdle) -> bool:
        """Return whether the words on a hurdle are above it: they keep clear of another one."""
        others = [
            each.height
            for each in self._hurdles
            if each is not hurdle and each.start < hurdle.stop and hurdle.start < each.stop
        ]
        return hurdle.height > max(others, default=float(self._trace.target[hurdle.start]))

    def _style(self, axes: "Axes", pen: Pen, label: str, keys: Sequence[Artist]) -> None:
        scale = pen.scale
        axes.set_ylabel(label, fontsize=pen.letters, color=INK, labelpad=3 * scale)
        axes.tick_params(labelsize=pen.letters, colors=FAINT, length=0, pad=4 * scale)
        axes.grid(color=LINE, linewidth=0.7 * scale)
        axes.set_axisbelow(True)
        for side in ("top", "left", "right"):
            axes.spines[side].set_visible(False)
        axes.spines["bottom"].set_color(LINE)
        axes.yaxis.set_label_coords(-41 * scale / axes.get_window_extent().width, 0.5)
        _legend(axes, pen, keys)


def _legend(axes: "Axes", pen: Pen, keys: Sequence[Artist]) -> Legend:
    """Draw a legend above the axes; in one row, it is drawn smaller where there is no room."""
    room = axes.get_window_extent().width
    sizes = SHRINKING if pen.rows == 0 else SHRINKING[:2]
    for size, spacing in sizes:
        legend = axes.legend(
            handles=list(keys),
            loc="lower left",
            bbox_to_anchor=(0, 1.0),
            borderaxespad=0.3,
            borderpad=0.2,
            ncols=-(-len(keys) // max(pen.rows, 1)),
            frameon=False,
            fontsize=size * pen.letters,
            handlelength=1.8,
            columnspacing=spacing,
            labelcolor=INK,
        )
        if legend.get_window_extent().width <= room:
            break
    return legend


def _range(series: Sequence[NDArray[np.float64]], least: float) -> tuple[float, float]:
    """Return the ends of an axis for some series, with a margin; ``least`` is its least length."""
    low, high = min(each.min() for each in series), max(each.max() for each in series)
    high = max(high, low + least)
    margin = 0.08 * (high - low)
    return float(low - margin), float(high + margin)
