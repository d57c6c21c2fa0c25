"""Learning of the reactive controller: claims, histogram of iterations (section IV.A)."""

import math
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from colift.agents.control.q_learning import ACTIONS, Q_PARAMETERS, learned_table, state_of
from colift.benchmark.paper.exhibits import Claim, Exhibit
from colift.benchmark.paper.table_one import LONGEST_ITERATIONS, MEDIAN_ITERATIONS, TRIALS
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.rendering.panels import legend, panels
from colift.benchmark.rendering.style import DASHES, FAINT, HUMAN, INK
from colift.benchmark.training.q_learning import LearningTrial
from numpy.typing import NDArray

LEVEL: Final = 0.01
"""Height difference within which the table counts as level [m]: half a position step."""

START: Final = 0.08
"""Largest initial height difference [m]."""

MANY: Final = 200
"""Number of trials for a firm answer."""


def learning_claims(trials: Sequence[LearningTrial]) -> list[Claim]:
    """Return the claims about convergence and about the learned controller."""
    iterations = np.array(
        [np.inf if trial.converged_at is None else trial.converged_at for trial in trials]
    )
    return [_median(iterations), _longest(iterations), _levels(trials)]


def _median(iterations: NDArray[np.float64]) -> Claim:
    median, tail = (float(np.quantile(iterations, q, method="higher")) for q in (0.5, 0.9))
    never = int(np.isinf(iterations).sum())
    return Claim(
        claim="Learning converges in about 40 iterations.",
        figure="Q-learning",
        paper=f"median {MEDIAN_ITERATIONS} iterations of {TRIALS} trials",
        criterion="median 26 to 46 and 90th percentile at most 75",
        measured=f"median {median:.0f}, 90th percentile {tail:.0f}, "
        f"over {_trials(len(iterations))}",
        values={"median": _finite(median), "p90": _finite(tail), "trials": len(iterations)},
        holds=bool(26 <= median <= 46 and tail <= 75),
        note=f"{_trials(never)} had not converged at the end of the phase: counted as never."
        + (f" A firm answer needs {MANY} trials." if len(iterations) < MANY else ""),
    )


def _longest(iterations: NDArray[np.float64]) -> Claim:
    rows = len(iterations) // TRIALS
    grouped = iterations[: rows * TRIALS].reshape(rows, -1) if rows else iterations[np.newaxis]
    longest = grouped.max(axis=1)
    low, middle, high = (
        float(np.quantile(longest, q, method="nearest")) for q in (0.05, 0.5, 0.95)
    )
    return Claim(
        claim=f"The longest of {TRIALS} trials takes {LONGEST_ITERATIONS} iterations.",
        figure="Q-learning",
        paper=f"{LONGEST_ITERATIONS}",
        criterion=f"{LONGEST_ITERATIONS} lies within the middle 90 % of the longest of ten trials",
        measured=f"longest of ten: median {middle:.0f}, middle 90 % {low:.0f} to {high:.0f}, "
        f"{len(longest)} {'group' if len(longest) == 1 else 'groups'} of ten trials",
        values={"low": _finite(low), "median": _finite(middle), "high": _finite(high)},
        holds=bool(low <= LONGEST_ITERATIONS <= high),
    )


def _levels(trials: Sequence[LearningTrial]) -> Claim:
    learned = sum(trial.converged_at is not None for trial in trials)
    shipped = _all_level(learned_table())
    right = sum(_all_level(trial.table) for trial in trials)
    return Claim(
        claim="The learned controller levels the table.",
        figure="Q-learning",
        paper="assumed by the experiments",
        criterion="greedy actions bring any height difference up to 8 cm within 1 cm in at most 4 "
        "actions, with the shipped table and with every converged one",
        measured=f"shipped table: {'yes' if shipped else 'no'}; {right} of {len(trials)} learned "
        f"tables, {learned} of which converged",
        values={"levelling": right, "converged": learned, "trials": len(trials)},
        holds=shipped
        and all(_all_level(trial.table) for trial in trials if trial.converged_at is not None),
    )


def _all_level(table: NDArray[np.float64]) -> bool:
    starts = np.linspace(-START, START, 33)
    return all(levels(table, float(start)) for start in starts)


def levels(table: NDArray[np.float64], difference: float, *, actions: int = 4) -> bool:
    """Return whether the greedy policy of a Q-table brings a height difference [m] to level.

    Kinematic: each action changes the difference by exactly its steps.
    """
    greedy = table.argmax(axis=1)
    for _ in range(actions):
        difference -= ACTIONS[greedy[state_of(difference)]] * Q_PARAMETERS.position_step
    return abs(difference) <= LEVEL + 1e-9


def _trials(count: int) -> str:
    return f"{count} trial" if count == 1 else f"{count} trials"


def _finite(value: float) -> float | None:
    return value if np.isfinite(value) else None


def learning_exhibit(trials: Sequence[LearningTrial], layout: Layout) -> Exhibit:
    """Return the histogram of the iterations to convergence."""
    converged = [trial.converged_at for trial in trials if trial.converged_at is not None]
    figure, ((axes,),) = panels(layout, ["trials"], [2.6], x_label="iterations until convergence")
    longest = max(len(trial.rewards) for trial in trials)
    axes.hist(converged, bins=list(range(0, longest + 5, 5)), color=HUMAN, alpha=0.65)
    lines: tuple[tuple[float, str, Any, str], ...] = (
        (float(np.median(converged)) if converged else math.nan, HUMAN, "-", "our median"),
        (MEDIAN_ITERATIONS, INK, "-", "the paper's median"),
        (LONGEST_ITERATIONS, FAINT, DASHES, "the paper's longest of ten"),
    )
    for value, colour, dashes, label in lines:
        axes.axvline(value, color=colour, lw=1.8, ls=dashes, label=label)
    legend(axes)
    return Exhibit(
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
