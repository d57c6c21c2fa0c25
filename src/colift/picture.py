"""The picture of an evaluation: each lift's error, by human behaviour."""

from typing import Final

import numpy as np

from colift.benchmark.bundle import Results
from colift.benchmark.episode.metric import LEADING
from colift.benchmark.execution.runner import Run
from colift.benchmark.rendering.figures import drawn_for, neutral_svg
from colift.benchmark.rendering.layout import PAGE
from colift.benchmark.rendering.panels import legend, panels
from colift.benchmark.rendering.style import DASHES, HUMAN, PEOPLE, ROBOT

ROW: Final = 0.36
"""Height of a row [inches]."""


def evaluation_picture(run: Run, results: Results) -> str:
    """Return the picture as an SVG element.

    Parameters
    ----------
    run
        The lifts: a dot each, and a solid line at the mean of each behaviour.
    results
        Its results: a dashed line at the mean of two people.
    """
    behaviours = list(dict.fromkeys(episode.behaviour for episode in run.episodes))
    with drawn_for(PAGE):
        figure, ((axes,),) = panels(
            PAGE, [""], [ROW * len(behaviours)], x_label=run.suite.metrics[LEADING].axis
        )
        for row, behaviour in enumerate(behaviours):
            errors = [e.scores["rmse_mm"] for e in run.episodes if e.behaviour == behaviour]
            strata = [each for each in results.strata if each.behaviour == behaviour]
            people = np.average(
                [each.human_human_rmse_mm for each in strata],
                weights=[each.episodes for each in strata],
            )
            ends = [row - 0.3, row + 0.3]
            names = (run.policy, PEOPLE) if row == 0 else (None, None)
            axes.plot(errors, np.full(len(errors), row), "o", color=ROBOT, alpha=0.35, ms=5, mew=0)
            axes.plot([np.mean(errors)] * 2, ends, color=ROBOT, lw=2, label=names[0])
            axes.plot([people] * 2, ends, color=HUMAN, lw=1.5, ls=DASHES, label=names[1])
        axes.set_yticks(range(len(behaviours)), behaviours)
        axes.set_ylim(len(behaviours) - 0.5, -0.5)
        axes.set_xlim(left=0)
        legend(axes)
        return neutral_svg(figure, f"RMSE of {run.policy} on {run.suite.name}, lift by lift")
