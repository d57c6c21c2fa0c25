"""The price of a channel as a figure: the error of each policy over each channel."""

from collections.abc import Sequence
from itertools import groupby
from typing import Final

from colift.benchmark.comparison.over_channels import OverChannel
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.panels import draw_lines, legend, panels
from matplotlib.figure import Figure

APART: Final = 0.05
"""Distance of the intervals of two policies, where the distance of channels is 1."""


def channels_figure(found: Sequence[OverChannel], layout: Layout) -> Figure:
    """Return the figure, a line for each policy, with 95 % intervals.

    Parameters
    ----------
    found
        What :func:`.over_channels` yields: policy by policy, each with the same channels.
    layout
        Size of the figure.
    """
    figure, ((axes,),) = panels(layout, ["RMSE [mm]"], [2.8])
    lines = {name: list(each) for name, each in groupby(found, key=lambda each: each.policy)}
    names = [each.channel or "no channel" for each in next(iter(lines.values()))]
    beside = [APART * (i - (len(lines) - 1) / 2) for i in range(len(lines))]
    draw_lines(
        axes,
        {
            name: [(place + x, each.rmse_mm.mean) for place, each in enumerate(line)]
            for x, (name, line) in zip(beside, lines.items(), strict=True)
        },
    )
    for drawn, line in zip(axes.get_lines(), lines.values(), strict=True):
        low, high = zip(*(each.rmse_mm.ends for each in line), strict=True)
        axes.vlines(drawn.get_xdata(), low, high, color=drawn.get_color(), lw=1.0)
    axes.set_xticks(range(len(names)), names)
    axes.set_ylim(bottom=0)
    legend(axes)
    return figure
