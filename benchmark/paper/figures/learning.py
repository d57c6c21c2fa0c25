"""How many iterations Q-learning takes to converge (section IV.A)."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ...learning import LearningTrial
from ...rendering.palette import FAINT, HUMAN, INK
from ..published import LONGEST_ITERATIONS, MEDIAN_ITERATIONS
from .picture import Picture, legend, panels


def learning_picture(trials: Sequence[LearningTrial]) -> Picture:
    """Return the histogram of the iterations to convergence."""
    converged = [trial.converged_at for trial in trials if trial.converged_at is not None]
    figure, ((axes,),) = panels(["trials"], [2.6], x_label="iterations until convergence")
    longest = max(len(trial.rewards) for trial in trials)
    axes.hist(converged, bins=list(range(0, longest + 5, 5)), color=HUMAN, alpha=0.65)
    lines: tuple[tuple[float, str, Any, str], ...] = (
        (float(np.median(converged)) if converged else math.nan, HUMAN, "-", "our median"),
        (MEDIAN_ITERATIONS, INK, "-", "the paper's median"),
        (LONGEST_ITERATIONS, FAINT, (0, (4, 3)), "the paper's longest of ten"),
    )
    for value, colour, dashes, label in lines:
        axes.axvline(value, color=colour, lw=1.8, ls=dashes, label=label)
    legend(axes)
    return Picture(
        name="q-learning",
        title="Q-learning: iterations to convergence",
        caption=f"{len(trials)} learning phases from an empty table, in the world, while the human "
        f"stands still; {len(trials) - len(converged)} did not converge within {longest} "
        "iterations. Converged means that the greedy action is the right one in all five states "
        "and stays so.",
        figure=figure,
        columns={
            "trial": list(range(len(trials))),
            "converged_at": [
                "" if trial.converged_at is None else trial.converged_at for trial in trials
            ],
        },
    )
