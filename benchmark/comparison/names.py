"""The names of the points, written near them and over nothing."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.text import Text

from ..rendering.labels import nearest, place_labels
from ..rendering.style import FAINT, INK
from .scale import Box, Scale, Spot

LETTERS: Final = 9.0
"""Size of letters [points]."""

MARKER: Final = 7.0
"""Size of a marker [points]."""


def write_names(
    axes: Axes, scale: Scale, drawn: Sequence[Spot], lines: Sequence[Box], words: Sequence[Text]
) -> None:
    """Write each name beside its point, or further off with a line to it.

    Parameters
    ----------
    axes, scale
        Where to write, limits set.
    drawn
        The points.
    lines, words
        What the names shall not cover, besides points and intervals; lines in units of the axes.
    """
    pixel = axes.figure.dpi / 72
    texts = [
        axes.text(0, 0, _told(scale, spot), fontsize=LETTERS, color=INK, zorder=4) for spot in drawn
    ]
    extents = [text.get_window_extent() for text in texts]
    points = axes.transData.transform([scale.place(spot) for spot in drawn])
    half = (MARKER / 2 + 1.5) * pixel
    bars = [bar for spot in drawn for bar in scale.bars(spot)]
    thin = axes.transData.transform(np.reshape([*bars, *lines], (-1, 2))).reshape(-1, 4)
    obstacles = [
        np.concatenate([points - half, points + half], axis=1),
        thin + pixel * np.array([-1, -1, 1, 1]),
        np.reshape([word.get_window_extent().extents for word in words], (-1, 4)),
    ]
    boxes = place_labels(
        points,
        [(extent.width + 2 * pixel, extent.height + 2 * pixel) for extent in extents],
        obstacles=np.concatenate(obstacles),
        bounds=axes.get_window_extent().extents,
    )
    to_data = axes.transData.inverted()
    for text, box, point in zip(texts, boxes, points, strict=True):
        x, y = to_data.transform((box[:2] + box[2:]) / 2)
        text.set(x=x, y=y, ha="center", va="center")
        end = nearest(box, point)
        if np.hypot(*(end - point)) > 2 * half:
            axes.plot(*to_data.transform([point, end]).T, color=FAINT, lw=0.7, zorder=2)


def _told(scale: Scale, spot: Spot) -> str:
    name = f"{spot.name} *" if spot.missing else spot.name
    if not scale.off(spot):
        return name
    smooth = "" if spot.y is None else f", SPARC {spot.y:.1f}"
    return f"{name}\n{spot.x:.0f} mm{smooth}"
