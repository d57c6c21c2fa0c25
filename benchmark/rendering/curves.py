"""The heights of both ends over time, drawn once, with a cursor that costs little."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.episode.drawn import DrawnSeries, intended_far_end
from colift.benchmark.episode.trace import Trace
from colift.benchmark.rendering.style import AIM, DASHES, FAINT, HUMAN, INK, LINE, PAPER, ROBOT
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.transforms import Bbox
from numpy.typing import NDArray
from PIL import Image, ImageDraw

DPI: Final = 100
LETTERS: Final = 8.5
"""Size of letters at scale 1 [points]."""

PALE: Final = 0.25
"""Opacity of the part after the cursor."""

DOTS: Final = (0, (1, 2))
"""Line style of a place on the table, in millimetres from its middle."""

STYLES: Final[Mapping[str, str]] = {"human": HUMAN, "robot": ROBOT, "place": INK}
"""Colours of added series by their place."""

GAP: Final = 0.28
"""Opacity of the area between the ends."""


class Curves:
    """Height over time of the human's end, the robot's end and the intention.

    Parameters
    ----------
    trace
        The lift; at least one frame.
    width, height
        Size of the picture [pixels].
    partner
        Name of the holder of the far end, for the legend.
    drawn
        Further series of the trace to draw: heights, or places on the table.
    scale
        Size of letters and lines; 1 suits a picture 640 pixels wide.
    """

    def __init__(
        self,
        trace: Trace,
        width: int,
        height: int,
        *,
        partner: str,
        drawn: Sequence[DrawnSeries] = (),
        scale: float = 1.0,
    ) -> None:
        self._scale = scale
        self._times = np.arange(1, len(trace.human_end) + 1) * FRAME
        self._ends = 1000 * np.stack([trace.human_end, trace.robot_end])
        self._target = 1000 * trace.target
        self._added = [(each, 1000 * trace.added[each.name]) for each in drawn]
        goal = intended_far_end(drawn)
        self._goal = None if goal is None else 1000 * trace.added[goal.name]
        self._partner = partner
        self._past = self._drawn(width, height, 1.0)
        self._future = self._drawn(width, height, PALE)

    def _drawn(self, width: int, height: int, opacity: float) -> Image.Image:
        scale, times, (human, robot) = self._scale, self._times, self._ends
        figure = Figure(figsize=(width / DPI, height / DPI), dpi=DPI, facecolor=PAPER)
        canvas = FigureCanvasAgg(figure)
        figure.subplots_adjust(
            left=58 * scale / width,
            right=1 - 18 * scale / width,
            bottom=42 * scale / height,
            top=1 - 30 * scale / height,
        )
        axes = figure.add_subplot()
        goal = self._goal
        meant, gap = (human, "difference") if goal is None else (goal, "error")
        axes.fill_between(times, meant, robot, color=FAINT, alpha=GAP * opacity, linewidth=0)
        dashes = DASHES
        axes.plot(times, self._target, color=INK, alpha=opacity, lw=0.9 * scale, ls=dashes)
        more = [
            (
                each.label,
                values,
                AIM if _is_aim(each) else STYLES[each.where],
                DOTS if each.where == "place" and not each.goal else dashes,
            )
            for each, values in self._added
        ]
        for _, values, colour, style in more:
            axes.plot(times, values, color=colour, alpha=opacity, lw=1.2 * scale, ls=style)
        for end, colour in ((human, HUMAN), (robot, ROBOT)):
            axes.plot(times, end, color=colour, alpha=opacity, lw=2.2 * scale)
        axes.legend(
            handles=[
                Line2D([], [], color=HUMAN, lw=2.2 * scale, label="human's end"),
                Line2D([], [], color=ROBOT, lw=2.2 * scale, label=f"{self._partner}'s end"),
                Patch(color=FAINT, alpha=GAP, lw=0, label=gap),
                Line2D([], [], color=INK, lw=0.9 * scale, ls=dashes, label="human's intention"),
                *(
                    Line2D([], [], color=colour, lw=1.2 * scale, ls=style, label=label)
                    for label, _, colour, style in more
                ),
            ],
            loc="lower left",
            bbox_to_anchor=(0, 1.0),
            borderaxespad=0.3,
            ncols=4 + len(more),
            frameon=False,
            fontsize=LETTERS * scale,
            handlelength=1.8,
            columnspacing=1.8 if not more else 1.1,
            labelcolor=INK,
        )
        every = [self._ends, self._target, *(values for _, values, _, _ in more)]
        low, high = min(each.min() for each in every), max(each.max() for each in every)
        high = max(high, low + 20)
        axes.set_ylim(low - 0.08 * (high - low), high + 0.08 * (high - low))
        axes.set_xlim(0, float(times[-1]))
        axes.set_xlabel("time [s]", fontsize=LETTERS * scale, color=INK, labelpad=2 * scale)
        axes.set_ylabel("height [mm]", fontsize=LETTERS * scale, color=INK, labelpad=3 * scale)
        axes.tick_params(labelsize=LETTERS * scale, colors=FAINT, length=0, pad=4 * scale)
        axes.grid(color=LINE, linewidth=0.7 * scale)
        axes.set_axisbelow(True)
        for side in ("top", "left", "right"):
            axes.spines[side].set_visible(False)
        axes.spines["bottom"].set_color(LINE)
        buffer, size = canvas.print_to_buffer()  # type: ignore[no-untyped-call]
        box: Bbox = axes.get_window_extent()
        self._top, self._bottom = height - box.y1, height - box.y0
        self._places = [
            axes.transData.transform(np.stack([times, end], axis=1)) * [1, -1] + [0, height]
            for end in self._ends
        ]
        return Image.frombytes("RGBA", size, bytes(buffer)).convert("RGB")

    def at(self, frame: int) -> Image.Image:
        """Return the curves with the cursor at a frame; the later part is pale."""
        picture = self._future.copy()
        reached = round(float(self._places[0][frame, 0]))
        picture.paste(self._past.crop((0, 0, reached, picture.height)))
        self._cursor(ImageDraw.Draw(picture), frame)
        return picture

    def marked(self, frames: Sequence[int]) -> Image.Image:
        """Return the whole curves with a cursor at each of the frames."""
        picture = self._past.copy()
        pen = ImageDraw.Draw(picture)
        for frame in frames:
            self._cursor(pen, frame)
        return picture

    def _cursor(self, pen: ImageDraw.ImageDraw, frame: int) -> None:
        points: list[NDArray[np.float64]] = [place[frame] for place in self._places]
        x = float(points[0][0])
        width = max(round(self._scale), 1)
        pen.line([(x, self._top), (x, self._bottom)], fill=INK, width=width)
        radius = 4.5 * self._scale
        for (_, y), colour in zip(points, (HUMAN, ROBOT), strict=True):
            pen.ellipse(
                (x - radius, y - radius, x + radius, y + radius),
                fill=colour,
                outline=PAPER,
                width=width,
            )


def _is_aim(each: DrawnSeries) -> bool:
    return each.where == "place" and each.goal
