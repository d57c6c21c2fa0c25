"""The sweep as a picture: error over latency, and over control period."""

import json
from collections.abc import Sequence
from dataclasses import asdict
from typing import Final

from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY
from colift.benchmark.references.oracle import ORACLE
from colift.benchmark.references.sweep import Swept
from colift.benchmark.rendering.style import FAINT, HUMAN, INK, PAPER, ROBOT, style_axes
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

LOOKS: Final = {
    "reactive": (FAINT, "-", "o"),
    "blend": ("#8A4F9E", "-", "o"),
    "anticipate": (ROBOT, "-", "o"),
    ORACLE: (INK, ":", "s"),
}
"""Colour, line and marker; the oracle, a reference, is black."""


def sweep_json(swept: Sequence[Swept], human_human: float) -> str:
    """Return the numbers of the picture; ``human_human`` is the baseline's RMSE [mm]."""
    content = {"human_human_rmse_mm": human_human, "swept": [asdict(each) for each in swept]}
    return json.dumps(content, indent=1) + "\n"


def sweep_figure(swept: Sequence[Swept], human_human: float, title: str) -> Figure:
    """Return the picture: on the left other latencies, on the right other control periods.

    Parameters
    ----------
    swept
        The scores.
    human_human
        Mean RMSE of the human-human baseline [mm], a line.
    title
        Text above the picture.
    """
    figure = Figure(figsize=(8.0, 4.2), dpi=130, facecolor=PAPER, layout="constrained")
    FigureCanvasAgg(figure)
    figure.suptitle(title, fontsize=11, color=INK, x=0.01, ha="left", weight="bold")
    left, right = figure.subplots(1, 2, sharey=True)
    _panel(left, [s for s in swept if s.control_period == CONTROL_PERIOD], "latency", human_human)
    _panel(right, [s for s in swept if s.latency == LATENCY], "control_period", human_human)
    left.set_xlabel(f"latency [ms], control period {1000 * CONTROL_PERIOD:.0f} ms", color=INK)
    right.set_xlabel(f"control period [ms], latency {1000 * LATENCY:.0f} ms", color=INK)
    left.set_ylabel("RMSE of the height difference [mm]", color=INK)
    left.legend(fontsize=8.5, labelcolor=INK, frameon=False, loc="upper left")
    left.set_ylim(bottom=0)
    return figure


def _panel(axes: Axes, swept: Sequence[Swept], along: str, human_human: float) -> None:
    style_axes(axes)
    axes.set_xticks(sorted({1000 * getattr(each, along) for each in swept}))
    axes.axhline(human_human, color=HUMAN, lw=1.2, ls=(0, (4, 3)), label="two people")
    for name, (colour, line, marker) in LOOKS.items():
        points = sorted((1000 * getattr(s, along), s.rmse_mm) for s in swept if s.policy == name)
        axes.plot(
            [x for x, _ in points],
            [y for _, y in points],
            color=colour,
            ls=line,
            marker=marker,
            ms=4,
            lw=1.8,
            label=name,
        )
