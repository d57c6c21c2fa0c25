"""Scores of a row, and the failures listed in a log."""

import re
from collections import Counter
from collections.abc import Sequence
from typing import Final

from colift.benchmark.bundle.content import Results, real_time
from colift.benchmark.episode.loop import Episode
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.scores import Paired, ScoreTable
from colift.benchmark.results.summary import summarise
from colift.benchmark.statistics import Estimate, difference_of_means
from colift.leaderboard.records.metrics import board_metrics
from colift.leaderboard.records.row import HiddenScores, PublicScores

PLACES: Final = 2
"""Decimals of published numbers of hidden episodes: 0.01 mm, well within any interval."""


def public_scores(results: Results) -> PublicScores:
    """Return the scores of the public run.

    Parameters
    ----------
    results
        Its results, with two people among the baselines.
    """
    summary = results.summary
    return PublicScores(
        episodes=summary.episodes,
        failed=summary.failed,
        rmse_mm=summary.rmse_mm,
        vs_human=_known(summary.vs_human),
        metrics={
            each.name: summary.metrics[each.name]
            for each in board_metrics(results.suite)
            if each.name in summary.metrics
        },
        step_ms_p50=summary.step_ms.p50,
        step_ms_p99=summary.step_ms.p99,
        real_time=summary.real_time,
    )


def hidden_scores(run: Run, human_human: ScoreTable) -> HiddenScores:
    """Return the published scores of the hidden run.

    Parameters
    ----------
    run
        The policy's complete run.
    human_human
        Two people on the same episodes.
    """
    scores = ScoreTable.of(run)
    summary = summarise(run, scores, human_human)
    better = scores.against(human_human).probability
    return HiddenScores(
        episodes=summary.episodes,
        failed=summary.failed,
        failures=dict(sorted(_failures(scores).items())),
        rmse_mm=summary.rmse_mm.rounded(PLACES),
        vs_human=_known(summary.vs_human).rounded(PLACES),
        real_time=real_time(summary.step_ms.p99, run.suite),
        better_than_human=None if better is None else round(better, PLACES),
        rougher=summary.rougher,
    )


def gap(hidden: Paired, public: Paired) -> Estimate:
    """Return the ratio to two people on hidden lifts, over that on public lifts.

    Parameters
    ----------
    hidden, public
        The policy's RMSE and that of two people, on hidden and on public lifts.
    """
    difference = difference_of_means(
        hidden.log_ratios, hidden.units, public.log_ratios, public.units
    )
    return difference.exponential().rounded(PLACES)


def _failures(scores: ScoreTable) -> Counter[str]:
    """Count the failed lifts by place of failure; see :attr:`.HiddenScores.failures`."""
    words = (reason.partition(" ")[0].rstrip(":") for reason in scores.failures if reason)
    return Counter(word if word in ("start", "step") else "table" for word in words)


def _known(ratio: Estimate | None) -> Estimate:
    if ratio is None:
        raise ValueError("two people are missing from this run")
    return ratio


MOST: Final = 20
"""Maximum number of different errors in a report."""

_STEP: Final = re.compile(r"(step \d+): (.*)", re.DOTALL)


def failure_lines(episodes: Sequence[Episode]) -> list[str]:
    """Return a line for each error with its first lift, the most frequent error first.

    Parameters
    ----------
    episodes
        Public lifts.
    """
    where: dict[str, list[str]] = {}
    for episode in episodes:
        if episode.failure is not None:
            place = f"{episode.behaviour}/{episode.subject} seed {episode.seed}"
            match = _STEP.fullmatch(episode.failure)
            reason = match[2] if match else episode.failure
            where.setdefault(reason, []).append(f"{place}, {match[1]}" if match else place)
    ordered = sorted(where.items(), key=lambda each: -len(each[1]))
    lines = [
        f"{len(places)} {'lift' if len(places) == 1 else 'lifts'}: {reason} (first: {places[0]})"
        for reason, places in ordered[:MOST]
    ]
    left = len(ordered) - MOST
    return [*lines, f"and {left} other errors"] if left > 0 else lines
