"""Learned policies as tables for a terminal."""

from typing import Final

import numpy as np
from colift.agents.control.anticipation import Anticipation
from colift.agents.control.learned_task import LearnedTask
from colift.agents.control.linear_forecast import TAPS, LinearForecast
from colift.agents.control.q_learning import ACTIONS, Q_PARAMETERS
from colift.benchmark.tables.printing import Cell, counted, table
from colift.benchmark.training.q_learning import LearningTrial
from rich.table import Table
from rich.text import Text

SHOWN: Final = 2
"""Step between the leads that are shown, so that the table fits a terminal."""


def task_table(task: LearnedTask) -> Table:
    """Return the components of the task model, the most frequent first."""
    impedance = task.impedance
    mixture = task.mixture
    rows = []
    for i in np.argsort(-mixture.weights, kind="stable"):
        height, *velocities = 1000 * mixture.means[i]
        speeds = (f"{velocities[0]:.0f}", f"{velocities[-1]:.0f}")
        share = f"{100 * mixture.weights[i]:.0f} %"
        rows.append((share, f"{height:.0f}", *speeds, f"{impedance.stiffness[i]:.2f}"))
    return table(
        "Situations (mean of each component of the mixture) and their stiffness",
        ("share", "height mm", "velocity mm/s", "then", "stiffness"),
        rows,
        caption=f"lead {1000 * impedance.lead:.0f} ms, offset {1000 * impedance.offset:.1f} mm, "
        f"tolerance {1000 * task.tolerance:.1f} mm",
    )


def q_table(trial: LearningTrial) -> Table:
    """Return the learned Q-table, a row per state."""
    steps = (1000 * action * Q_PARAMETERS.position_step for action in ACTIONS)
    edges = ["", *(f"{1000 * edge:+.0f}" for edge in Q_PARAMETERS.edges), ""]
    rows: list[tuple[Cell, ...]] = []
    for low, high, row in zip(edges, edges[1:], trial.table, strict=False):
        best = int(np.argmax(row))
        name = f"{low} to {high} mm" if low and high else f"above {low}" if low else f"below {high}"
        cells = (
            Text(f"{1000 * value:.1f}", "bold" if i == best else "") for i, value in enumerate(row)
        )
        rows.append((name, *cells))
    return table(
        "Q-table (mm of tilt removed); the greedy action is bold",
        ("human - robot", *(f"{step:+.0f} mm" for step in steps)),
        rows,
    )


def convergence_text(trials: list[LearningTrial]) -> str:
    """Return the number of iterations to convergence, as text."""
    found = [trial.converged_at for trial in trials if trial.converged_at is not None]
    if len(trials) == 1:
        when = found[0] if found else None
        return f"converged after {counted(when, 'iteration')}" if when else "did not converge"
    missed = len(trials) - len(found)
    counts = [*found, *[10**9] * missed]
    median, ninetieth = np.percentile(counts, [50, 90])
    return (
        f"{len(trials)} trials: median {median:.0f} iterations to converge, "
        f"90th percentile {ninetieth:.0f}, {missed} did not converge (paper: median 36)"
    )


def anticipation_table(models: list[Anticipation]) -> Table:
    """Return the error of the predicted height at each lead, after each round."""
    leads = models[-1].leads[::SHOWN]
    return table(
        "Error of the predicted height on the training lifts, rms mm",
        ("round", "samples", *(f"{1000 * np.round(lead, 3):+.0f} ms" for lead in leads)),
        (
            (
                str(number),
                str(model.provenance["samples"]),
                *(f"{error:.2f}" for error in model.provenance["rms_error_mm"][::SHOWN]),
            )
            for number, model in enumerate(models, 1)
        ),
    )


def linear_table(forecast: LinearForecast) -> Table:
    """Return the weights of the linear forecast at each horizon, and its error."""
    errors = forecast.provenance["mean_rmse_mm"]
    return table(
        "Rise of the human's end as a sum of its past changes, the latest first",
        ("ahead", "RMSE mm", *(str(number) for number in range(1, TAPS))),
        (
            (f"{1000 * horizon:.0f} ms", f"{error:.2f}", *(f"{weight:+.2f}" for weight in row))
            for horizon, error, row in zip(
                forecast.horizons.tolist(), errors, forecast.weights.tolist(), strict=True
            )
        ),
    )
