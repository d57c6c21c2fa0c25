"""A lift as a figure for print: three moments, and the chart of heights under them."""

from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.episode.drawn import (
    DrawnSeries,
    ball_and_target,
    intended_far_end,
    shown_error,
)
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import drawn_series
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.rendering.bodies import label_of
from colift.benchmark.rendering.cameras import SIDE
from colift.benchmark.rendering.chart import LETTERS, Chart, Pen
from colift.benchmark.rendering.figures import DPI, drawn_for
from colift.benchmark.rendering.film import still_moments
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.lift_scene import LiftScene
from colift.benchmark.rendering.scene import Picture
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

CHART: Final = 1.75
PANEL: Final = 0.8
"""Heights of the chart and of each further axis [inches]."""

GUTTER: Final = 0.05
"""Gap between two moments [inches]."""

WORDS: Final = 3.0
"""Room for the two lines above a moment, relative to the size of letters."""

LOW: Final = 0.6
"""Height of a moment on a slide, relative to its width."""

MOST_ROWS: Final = 4
"""Most rows of a legend."""


def lift_title(episode: Episode, policy: str) -> str:
    """Return a lift in a line, for readers of a file."""
    return (
        f"{policy}, {episode.behaviour}, {episode.subject}, seed {episode.seed}: "
        f"RMSE {episode.scores['rmse_mm']:.1f} mm"
    )


def lift_figure(
    episode: Episode, scenario: Scenario, layout: Layout, *, camera: str = SIDE
) -> Figure:
    """Return the figure; its words are text, and only the moments are pictures of pixels.

    Parameters
    ----------
    episode
        A finished episode.
    scenario
        Its scenario.
    layout
        Size of the figure.
    camera
        View of the moments; see :data:`.CAMERAS`.

    Raises
    ------
    InputError
        If the episode ended before its first frame, or the camera is unknown.
    """
    drawn = drawn_series(scenario.task.metrics)
    moments = still_moments(episode, drawn)
    width = (layout.width - GUTTER * (len(moments) - 1)) / len(moments)
    height = width if layout.height is None else LOW * width
    size = round(DPI * width), round(DPI * height)
    with LiftScene(episode.trace, scenario.partner, drawn, camera) as lift:
        views = [_view(lift, frame, size) for frame in moments]
    captions = [_caption(episode, frame, drawn) for frame in moments]
    chart = Chart(episode.trace, partner=label_of(scenario.partner), drawn=drawn)
    with drawn_for(layout):
        for rows in range(1, MOST_ROWS + 1):
            figure, panels = _drawn(chart, moments, views, captions, layout, rows)
            if all(map(_fits, panels)):
                break
    return figure


def _view(lift: LiftScene, frame: int, size: tuple[int, int]) -> Picture:
    lift.show(frame)
    return lift.scene.picture(*size)


def _caption(episode: Episode, frame: int, drawn: tuple[DrawnSeries, ...]) -> str:
    """Return the time and the error of a moment."""
    level = intended_far_end(drawn) is None and ball_and_target(drawn) is None
    error = 1000 * abs(float(shown_error(drawn, episode.trace)[frame]))
    return f"{(frame + 1) * FRAME:.1f} s\n{'difference' if level else 'error'} {error:.0f} mm"


def _drawn(
    chart: Chart,
    moments: list[int],
    views: list[Picture],
    captions: list[str],
    layout: Layout,
    rows: int,
) -> tuple[Figure, list[Axes]]:
    """Return a figure whose legends have a number of rows, and the axes of its chart."""
    pen = Pen(scale=layout.letters / LETTERS, rows=rows)
    above = views[0].shape[0] / DPI + WORDS * layout.letters / 72
    below = CHART + PANEL * (chart.panels - 1) + (pen.strip - Pen(scale=pen.scale).strip) / 100
    figure = Figure(figsize=layout.size(above + below))
    FigureCanvasAgg(figure)
    total = figure.get_figheight()
    (upper,), (lower,) = figure.subfigures(
        2, 1, squeeze=False, height_ratios=(above, total - above)
    )
    upper.subplots_adjust(
        left=0,
        right=1,
        bottom=0,
        top=1 - WORDS * layout.letters / 72 / above,
        wspace=GUTTER * DPI / views[0].shape[1],
    )
    across = upper.subplots(1, len(views))
    for axes, view, caption in zip(across, views, captions, strict=True):
        axes.imshow(view, aspect="auto", interpolation="none")
        axes.set_axis_off()
        axes.set_title(caption, pad=3, linespacing=1.15)
    return figure, chart.draw(lower, pen, moments)


def _fits(axes: Axes) -> bool:
    """Return whether the legend of an axis is no wider than the axis."""
    legend = axes.get_legend()
    return legend is None or bool(
        np.less_equal(legend.get_window_extent().width, axes.get_window_extent().width)
    )
