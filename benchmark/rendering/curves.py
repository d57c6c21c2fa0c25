"""The chart of a lift, drawn once, with a cursor that costs little."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from colift.benchmark.rendering.chart import Chart, Pen
from colift.benchmark.rendering.style import INK, PAPER
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image, ImageDraw

DPI: Final = 100

PALE: Final = 0.25
"""Opacity of the part after the cursor."""


class Curves:
    """A chart as a picture, with cursors.

    Parameters
    ----------
    chart
        The chart.
    width, height
        Size of the picture [pixels].
    scale
        Size of letters and lines; 1 suits a picture 640 pixels wide.
    """

    def __init__(self, chart: Chart, width: int, height: int, *, scale: float = 1.0) -> None:
        self.height = height
        self._chart = chart
        self._scale = scale
        self._size = width, height
        self._past = self._drawn(1.0)
        self._future = self._drawn(PALE)

    def _drawn(self, opacity: float, moments: Sequence[int] = ()) -> Image.Image:
        chart, (width, height) = self._chart, self._size
        figure = Figure(figsize=(width / DPI, height / DPI), dpi=DPI, facecolor=PAPER)
        canvas = FigureCanvasAgg(figure)
        panels = chart.draw(figure, Pen(scale=self._scale, opacity=opacity), moments)
        buffer, size = canvas.print_to_buffer()  # type: ignore[no-untyped-call]
        boxes = [axes.get_window_extent() for axes in panels]
        self._lines = [(height - box.y1, height - box.y0) for box in boxes]
        self._dots = [
            (
                axes.transData.transform(np.stack([chart.times, values], axis=1)) * [1, -1]
                + [0, height],
                colour,
            )
            for axes, curves in zip(panels, chart.curves(), strict=True)
            for values, colour in curves
        ]
        return Image.frombytes("RGBA", size, bytes(buffer)).convert("RGB")

    def at(self, frame: int) -> Image.Image:
        """Return the curves with the cursor at a frame; the later part is pale."""
        picture = self._future.copy()
        reached = round(float(self._dots[0][0][frame, 0]))
        picture.paste(self._past.crop((0, 0, reached, picture.height)))
        self._cursor(ImageDraw.Draw(picture), frame)
        return picture

    def marked(self, frames: Sequence[int]) -> Image.Image:
        """Return the whole curves with a line at each of the frames."""
        return self._drawn(1.0, frames)

    def _cursor(self, pen: ImageDraw.ImageDraw, frame: int) -> None:
        width = max(round(self._scale), 1)
        radius = 4.5 * self._scale
        here = float(self._dots[0][0][frame, 0])
        for top, bottom in self._lines:
            pen.line([(here, top), (here, bottom)], fill=INK, width=width)
        for places, colour in self._dots:
            x, y = places[frame]
            pen.ellipse(
                (x - radius, y - radius, x + radius, y + radius),
                fill=colour,
                outline=PAPER,
                width=width,
            )
