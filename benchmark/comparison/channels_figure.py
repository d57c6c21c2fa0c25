"""The price of a channel as a figure: the error of each policy over each channel."""

from collections.abc import Sequence
from itertools import groupby

from colift.benchmark.comparison.over_channels import OverChannel
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.panels import draw_estimates, legend, panels
from matplotlib.figure import Figure


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
    draw_estimates(
        axes,
        {name: [*enumerate(each.rmse_mm for each in line)] for name, line in lines.items()},
    )
    axes.set_xticks(range(len(names)), names)
    axes.set_ylim(bottom=0)
    legend(axes)
    return figure
