"""Remarks on results: what a score says of a policy that has no error to report."""

from collections.abc import Mapping
from typing import Final

from colift.agents.actions import action_limit
from colift.benchmark.episode.scenario import CONTROL_PERIOD
from colift.benchmark.results.baselines import HUMAN_HUMAN
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.results.summary import Summary
from colift.benchmark.tasks.level.table import MOSTLY_CLIPPED

MEANINGS: Final = {"hold": "never moves", "copy": "goes where the human was"}
"""Descriptions of the simple policies with which every score is compared."""


def remarks(summary: Summary, baselines: Mapping[str, ScoreTable]) -> list[str]:
    """Return a sentence for each result that a mistake in the policy would explain."""
    units, worse = unit_remark(summary), worse_remark(summary, baselines)
    share = summary.metrics["clipped"].mean if units else None
    clipped = "" if share is None else f"{clipped_text(share)}. {units}"
    return [each for each in (clipped, worse) if each]


def clipped_text(share: float) -> str:
    """Return the share of clipped actions in words."""
    limit = action_limit(CONTROL_PERIOD)
    return f"{100 * share:.1f} % were clipped: the hands move at most {limit:g} m per step"


def unit_remark(summary: Summary) -> str:
    """Return what actions are, if most were clipped; else an empty text."""
    measured = summary.metrics.get("clipped")
    if measured is None or measured.mean is None or measured.mean <= MOSTLY_CLIPPED:
        return ""
    return "An action must be a change of the height, in metres"


def worse_remark(summary: Summary, baselines: Mapping[str, ScoreTable]) -> str:
    """Return the simple policies that are better on the same lifts; an empty text if none is."""
    means = {
        name: baseline.mean
        for name, baseline in baselines.items()
        if name != HUMAN_HUMAN and baseline.mean < summary.rmse_mm.mean
    }
    if not means:
        return ""
    better = (f"{name} ({MEANINGS[name]}, {mean:.2f} mm)" for name, mean in means.items())
    return f"Worse than {' and '.join(better)}"
