"""Recorded pairs and the simulated two people in a picture."""

from typing import Final

import numpy as np
from colift.benchmark.pairs.coordination import MEASURES
from colift.benchmark.pairs.recorded import PairLift, RecordedPairs
from colift.benchmark.pairs.summary import PairsSummary
from colift.benchmark.rendering.style import FAINT, HUMAN, INK, LINE, PAPER, ROBOT, style_axes
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

SHOWN: Final = ("rmse_mm", "rmse_about_mean_mm", "lag_ms", "gain")
"""The measures that have a panel."""

SPREAD: Final = 0.22
"""Half the width over which the pairs of a column are spread."""

BAR: Final = 0.36
"""Place of a mean beside the middle of its column."""

LETTERS: Final = 8.5
"""Size of letters [points]."""


def pairs_figure(pairs: RecordedPairs, summary: PairsSummary) -> Figure:
    """Return the picture: above, the lift whose RMSE is the median; below, each lift's measures.

    A line joins a recorded lift with the simulated one on the same movement; a bar is a mean with
    its interval over lifts.
    """
    figure = Figure(figsize=(7.0, 4.8), dpi=150, facecolor=PAPER, layout="constrained")
    FigureCanvasAgg(figure)
    grid = figure.add_gridspec(2, len(SHOWN), height_ratios=(1.0, 1.25))
    order = sorted(pairs.lifts, key=lambda lift: summary.lifts[lift.name].rmse_mm)
    _example(figure.add_subplot(grid[0, :]), order[(len(order) - 1) // 2], summary)
    for column, name in enumerate(SHOWN):
        _panel(figure.add_subplot(grid[1, column]), name, summary)
    several = ", side by side for each pair" if summary.people > 1 else ""
    figure.supxlabel(
        f"Dots: lifts{several}. Lines join the same movement. Bars: mean, 95 % over lifts.",
        fontsize=LETTERS,
        color=FAINT,
    )
    return figure


def _example(axes: Axes, lift: PairLift, summary: PairsSummary) -> None:
    style_axes(axes)
    ends, found = lift.ends, summary.lifts[lift.name]
    times = ends.times - ends.times[0]
    start = float(ends.near[0])
    near, far = 1000.0 * (ends.near - start), 1000.0 * (ends.far - start)
    axes.fill_between(times, near, far, color=FAINT, alpha=0.28, linewidth=0)
    axes.plot(times, near, color=HUMAN, lw=1.6, label="recorded hand's end")
    axes.plot(times, far, color=ROBOT, lw=1.6, label="other person's end")
    axes.set_xlim(0.0, float(times[-1]))
    axes.set_xlabel("time [s]", fontsize=LETTERS, color=INK)
    axes.set_ylabel("height [mm]", fontsize=LETTERS, color=INK)
    axes.legend(
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
        ncols=2,
        frameon=False,
        fontsize=LETTERS,
        labelcolor=INK,
    )
    axes.set_title(
        f"{lift.name:.40}: RMSE {found.rmse_mm:.1f} mm", fontsize=LETTERS, color=INK, loc="right"
    )


def _panel(axes: Axes, name: str, summary: PairsSummary) -> None:
    style_axes(axes)
    measure = MEASURES[name]
    names = list(dict.fromkeys(summary.pairs.values()))
    places = np.linspace(-SPREAD, SPREAD, len(names)) if len(names) > 1 else np.zeros(1)
    for trial, recorded in summary.lifts.items():
        simulated = summary.simulated.lifts.get(trial)
        x = float(places[names.index(summary.pairs[trial])])
        one = getattr(recorded, name)
        other = np.nan if simulated is None else getattr(simulated, name)
        axes.plot((x, 1.0 + x), (one, other), color=LINE, lw=0.8, zorder=1)
        for column, value, colour in ((0, one, HUMAN), (1, other, FAINT)):
            axes.plot(column + x, value, "o", color=colour, ms=3.2, alpha=0.75, mew=0, zorder=2)
    averaged = summary.averages.get(name)
    for column, mean in enumerate((averaged.recorded, averaged.simulated) if averaged else ()):
        if mean is not None:
            (low, high), x = mean.ends, column + BAR
            axes.plot((x, x), (low, high), color=INK, lw=1.6, zorder=3)
            axes.plot((x - 0.08, x + 0.08), (mean.mean,) * 2, color=INK, lw=1.6, zorder=3)
    shown = ("recorded", "simulated") if summary.simulated.lifts else ("recorded",)
    axes.set_xlim(-0.5, len(shown) - 0.5)
    axes.set_xticks(range(len(shown)), shown)
    axes.tick_params(axis="x", colors=INK)
    if name.startswith("rmse"):
        axes.set_ylim(bottom=0.0)
    unit = f" [{measure.unit}]" if measure.unit else ""
    axes.set_title(f"{measure.label}{unit}", fontsize=LETTERS, color=INK)
