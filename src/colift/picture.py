"""The picture of an evaluation: each lift's error, by human behaviour."""

import io
from typing import Final

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from colift.benchmark.bundle import Results
from colift.benchmark.execution.runner import Run
from colift.benchmark.rendering.style import HUMAN, INK, ROBOT, style_axes

ROW: Final = 0.42
"""Height of a row [inches]."""


def evaluation_picture(run: Run, results: Results) -> str:
    """Return the picture as an SVG element.

    Parameters
    ----------
    run
        The lifts: a dot each, and a solid line at the mean of each behaviour.
    results
        Its results: a dashed line at the mean of the human-human baseline.
    """
    behaviours = list(dict.fromkeys(episode.behaviour for episode in run.episodes))
    figure = Figure(figsize=(7.0, 1.0 + ROW * len(behaviours)), layout="constrained")
    axes = figure.add_subplot()
    style_axes(axes)
    for row, behaviour in enumerate(behaviours):
        errors = [e.scores["rmse_mm"] for e in run.episodes if e.behaviour == behaviour]
        strata = [each for each in results.strata if each.behaviour == behaviour]
        human_human = np.average(
            [each.human_human_rmse_mm for each in strata],
            weights=[each.episodes for each in strata],
        )
        axes.plot(errors, np.full(len(errors), row), "o", color=ROBOT, alpha=0.35, ms=5, mew=0)
        ends = [row - 0.3, row + 0.3]
        axes.plot([np.mean(errors)] * 2, ends, color=ROBOT, lw=2, label=_once(run.policy, row))
        axes.plot(
            [human_human] * 2, ends, "--", color=HUMAN, lw=1.5, label=_once("two people", row)
        )
    axes.set_yticks(range(len(behaviours)), behaviours)
    axes.set_ylim(len(behaviours) - 0.5, -0.5)
    axes.set_xlim(left=0)
    axes.set_xlabel("RMSE of the height difference [mm]", fontsize=9, color=INK)
    axes.set_title(f"{run.policy} on {run.suite.name}", loc="left", fontsize=10, color=INK)
    figure.legend(loc="outside right upper", frameon=False, fontsize=8.5)
    buffer = io.StringIO()
    with mpl.rc_context({"svg.fonttype": "none", "svg.hashsalt": "evaluation"}):
        figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    text = buffer.getvalue()
    return text[text.index("<svg") :]


def _once(label: str, row: int) -> str:
    """Return the label in the first row, else one that a legend leaves out."""
    return label if row == 0 else "_"
