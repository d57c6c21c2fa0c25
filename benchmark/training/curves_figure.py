"""The curves of a training as a figure: a line for each seed, and their mean."""

from collections.abc import Sequence

import numpy as np
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.panels import legend, panels
from colift.benchmark.rendering.style import FAINT, ROBOT
from colift.benchmark.training.course import Course
from matplotlib.figure import Figure
from matplotlib.ticker import EngFormatter


def curves_figure(courses: Sequence[Course], layout: Layout) -> Figure:
    """Return the figure of trainings that have ended: the error on the validation lifts.

    The mean is over the steps that all seeds have reached, between their points by interpolation.
    """
    figure, ((axes,),) = panels(layout, ["RMSE [mm]"], [2.4], x_label="steps")
    curves = [np.array(each.curve) for each in courses]
    seeds = [(curve[:, 0], curve[:, 2]) for curve in curves]
    several = len(seeds) > 1
    for i, (steps, errors) in enumerate(seeds):
        colour, width = (FAINT, 0.8) if several else (ROBOT, 1.8)
        label = "each seed" if several and i == 0 else None
        axes.plot(steps, errors, color=colour, lw=width, label=label)
    if several:
        shared = np.unique(np.concatenate([steps for steps, _ in seeds]))
        shared = shared[shared <= min(steps[-1] for steps, _ in seeds)]
        mean = np.mean([np.interp(shared, *each) for each in seeds], axis=0)
        axes.plot(shared, mean, color=ROBOT, lw=1.8, label=f"mean of {len(seeds)} seeds")
        legend(axes)
    axes.xaxis.set_major_formatter(EngFormatter())
    axes.set_ylim(bottom=0)
    return figure
