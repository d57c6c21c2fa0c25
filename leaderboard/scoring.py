"""From the runs of an evaluation to what a row says of them."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np

from ..benchmark.comparison.standing import Estimate
from ..benchmark.references import Reference
from ..benchmark.runner import Run
from ..benchmark.statistics import difference_of_means_ci, probability_better
from ..benchmark.summary import cell, summarise
from .row import HiddenScores, PublicScores

PLACES: Final = 2
"""Decimals of what is told of hidden episodes: 0.01 mm, well within any interval."""


def public_scores(results: Mapping[str, Any]) -> PublicScores:
    """Return what a row says of the public run.

    Parameters
    ----------
    results
        The content of its bundle's ``results.json``, the human-human team among the references.
    """
    summary = results["summary"]
    return PublicScores(
        episodes=summary["episodes"],
        failed=summary["failed"],
        rmse_mm=_estimate(summary["rmse_mm"]),
        vs_human=_estimate(summary["vs_human"]),
        sparc=summary["sparc"]["mean"],
        sparc_missing=summary["sparc"]["missing"],
        human_force_n=summary["human_force_n"]["mean"],
        step_ms_p50=summary["step_ms"]["p50"],
        step_ms_p99=summary["step_ms"]["p99"],
        real_time=bool(summary["real_time"]),
    )


def hidden_scores(run: Run, team: Reference) -> HiddenScores:
    """Return what a row says of the hidden run.

    Parameters
    ----------
    run
        The policy's complete run.
    team
        The human-human team on the same episodes.
    """
    summary = summarise(run.episodes, team.rmse_mm)
    failures = _failures(run)
    sure = probability_better(_rmse(run), team.rmse_mm, team.cells)
    return HiddenScores(
        episodes=summary["episodes"],
        failed=summary["failed"],
        failures=dict(sorted(failures.items())),
        rmse_mm=_rounded(_estimate(summary["rmse_mm"])),
        vs_human=_rounded(_estimate(summary["vs_human"])),
        better_than_human=round(sure, PLACES),
    )


def gap(hidden: Run, public: Run) -> Estimate:
    """Return by how much the mean RMSE of the hidden run is above the public one's [mm]."""
    a, b = _rmse(hidden), _rmse(public)
    cells_a, cells_b = ([cell(episode) for episode in run.episodes] for run in (hidden, public))
    interval = difference_of_means_ci(a, cells_a, b, cells_b)
    return _rounded(Estimate(mean=float(np.mean(a) - np.mean(b)), ci95=interval))


def _rmse(run: Run) -> list[float]:
    return [episode.scores.rmse_mm for episode in run.episodes]


def _failures(run: Run) -> Counter[str]:
    """Count the failed episodes by where they failed; see :attr:`.HiddenScores.failures`."""
    reasons = [episode.failure for episode in run.episodes if episode.failure is not None]
    words = (reason.partition(" ")[0].rstrip(":") for reason in reasons)
    return Counter(word if word in ("start", "step") else "table" for word in words)


def _estimate(content: Mapping[str, Any]) -> Estimate:
    low, high = content["ci95"]
    return Estimate(mean=content["mean"], ci95=(low, high))


def _rounded(estimate: Estimate) -> Estimate:
    mean, low, high = _places((estimate.mean, *estimate.ci95))
    return Estimate(mean=mean, ci95=(low, high))


def _places(values: Sequence[float]) -> list[float]:
    return [round(value, PLACES) for value in values]
