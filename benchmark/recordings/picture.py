"""A picture of lifts: all from the start of their rise, and where they were cut from."""

import io
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from colift.benchmark.recordings.takes import Take
from colift.benchmark.recordings.unseen import gaps_in
from colift.benchmark.rendering.style import FAINT, HUMAN, INK, LINE, PAPER, ROBOT, style_axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

MOST: Final = 10
"""Most takes that are drawn on their own."""

WIDTH: Final = 8.0
"""[in]"""

TOP: Final = 2.9
"""Height of the axes of all lifts, with their labels [in]."""

ROW: Final = 0.95
"""Height of the axes of a take [in]."""

DPI: Final = 150

LONGEST_NAME: Final = 60
"""[characters]"""


def lifts_png(takes: Sequence[Take]) -> bytes:
    """Return the picture as PNG: the same lifts give the same bytes."""
    shown = takes[:MOST]
    figure = Figure(
        figsize=(WIDTH, TOP + ROW * len(shown) + 0.4), facecolor=PAPER, layout="constrained"
    )
    FigureCanvasAgg(figure)
    axes = figure.subplots(1 + len(shown), 1, height_ratios=[TOP, *([ROW] * len(shown))])
    _all(axes[0], takes)
    for place, take in zip(axes[1:], shown, strict=True):
        _one(place, take)
    axes[-1].set_xlabel(_last_label(len(takes)), fontsize=9, color=INK)
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=DPI, metadata={"Software": None})
    return buffer.getvalue()


def _last_label(count: int) -> str:
    more = f" ({count - MOST} more takes are not drawn)" if count > MOST else ""
    return f"time in the recording [s]{more}"


def _all(axes: Any, takes: Sequence[Take]) -> None:
    lifts = [lift for take in takes for lift in take.lifts]
    opacity = float(np.clip(8.0 / max(len(lifts), 1), 0.15, 0.9))
    for lift in lifts:
        rising = [i for i, phase in enumerate(lift.phases) if phase == "rise"] or [0]
        start = rising[0]
        times = lift.times - lift.times[start]
        if lift.far is not None:
            far = lift.far - lift.far[start]
            axes.plot(times, far, color=ROBOT, linewidth=1.2, alpha=opacity)
        axes.plot(
            times, lift.heights - lift.heights[start], color=HUMAN, linewidth=1.4, alpha=opacity
        )
    style_axes(axes)
    many = f"{len(lifts)} lift" + "s" * (len(lifts) != 1)
    axes.set_title(f"{many}, from the start of the rise", fontsize=10, color=INK, loc="left")
    axes.set_ylabel("height [m]", fontsize=9, color=INK)
    axes.set_xlabel("time [s]", fontsize=9, color=INK)
    if any(lift.far is not None for lift in lifts):
        axes.plot([], [], color=HUMAN, label="hand")
        axes.plot([], [], color=ROBOT, label="other end")
        axes.legend(frameon=False, fontsize=8.5, loc="upper left")


def _one(axes: Any, take: Take) -> None:
    times, heights = take.motion.times, take.track.heights
    axes.plot(times, heights, color=FAINT, linewidth=0.9)
    for lift in take.lifts:
        axes.plot(lift.times, lift.heights, color=HUMAN, linewidth=1.8)
    for gap in gaps_in(heights):
        left, right = times[max(gap.start - 1, 0)], times[min(gap.stop, len(times) - 1)]
        axes.axvspan(left, right, color=ROBOT, alpha=0.25, linewidth=0)
    style_axes(axes)
    axes.grid(color=LINE, linewidth=0.5)
    axes.margins(x=0.0)
    title = take.file.name + (f" {take.motion.take}" if take.motion.take else "")
    if len(title) > LONGEST_NAME:
        title = f"{title[: LONGEST_NAME - 1]}…"
    unseen = ", not seen: shaded" if np.isnan(heights).any() else ""
    axes.set_title(
        f"{title}: {take.track.hand[:LONGEST_NAME]}, up {take.track.up}{unseen}",
        fontsize=8.5,
        color=INK,
        loc="left",
        pad=3,
    )
    axes.tick_params(labelsize=7.5)
