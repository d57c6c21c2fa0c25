"""The sweep as a figure: error over latency, and over control period."""

import json
from collections.abc import Sequence
from dataclasses import asdict

from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY
from colift.benchmark.references.sweep import NAMES, Swept
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.panels import draw_lines, draw_people, panels, shared_legend
from matplotlib.axes import Axes
from matplotlib.figure import Figure


def sweep_json(swept: Sequence[Swept], human_human: float) -> str:
    """Return the numbers of the figure; ``human_human`` is the baseline's RMSE [mm]."""
    content = {"human_human_rmse_mm": human_human, "swept": [asdict(each) for each in swept]}
    return json.dumps(content, indent=1) + "\n"


def sweep_figure(swept: Sequence[Swept], human_human: float, layout: Layout) -> Figure:
    """Return the figure: first other latencies, then other control periods.

    Parameters
    ----------
    swept
        The scores.
    human_human
        Mean RMSE of the human-human baseline [mm], a line.
    layout
        Size of the figure.
    """
    figure, ((first, second),) = panels(layout, ["RMSE [mm]"], [2.4], columns=2, share_x=False)
    _panel(first, [s for s in swept if s.control_period == CONTROL_PERIOD], "latency", human_human)
    _panel(second, [s for s in swept if s.latency == LATENCY], "control_period", human_human)
    first.set_xlabel(f"latency [ms], control period {1000 * CONTROL_PERIOD:.0f} ms")
    second.set_xlabel(f"control period [ms], latency {1000 * LATENCY:.0f} ms")
    first.set_ylim(bottom=0)
    shared_legend(first)
    return figure


def _panel(axes: Axes, swept: Sequence[Swept], along: str, human_human: float) -> None:
    axes.set_xticks(sorted({1000 * getattr(each, along) for each in swept}))
    draw_people(axes, human_human)
    draw_lines(
        axes,
        {
            name: [(1000 * getattr(s, along), s.rmse_mm) for s in swept if s.policy == name]
            for name in NAMES
        },
    )
