"""From episodes to the numbers of a results table."""

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..episode.episode import Episode
from ..episode.metric import LEADING, Metrics, reached
from ..statistics import (
    interquartile_mean,
    mean_of,
    mean_with_missing,
    ratio_of_means,
)

Stratum = tuple[str, str]


def stratum(episode: Episode) -> Stratum:
    """Return the behaviour and the subject of an episode: its stratum."""
    return episode.behaviour, episode.subject


def summarise(
    episodes: Sequence[Episode], metrics: Metrics, human_human: Sequence[float] | None = None
) -> dict[str, Any]:
    """Return the summary of a policy's episodes.

    ``rmse_mm`` has mean, interquartile mean and the mean's 95 % confidence interval, by bootstrap
    over the episodes within each behaviour and subject. The other metrics have the mean over the
    episodes that have one and the number of those that do not (``missing``): a policy that does
    not move has no smoothness, and ranks last by it. Step times are percentiles over all calls
    of the policy [ms].

    Parameters
    ----------
    episodes
        The policy's episodes.
    metrics
        The metrics of the task.
    human_human
        RMSE of the human-human team on the same episodes [mm]. With it, ``vs_human`` is the ratio
        of the means, with the 95 % interval of a bootstrap that pairs the episodes: 1 is as good
        as a human partner, less is better. Without it, ``vs_human`` is None.
    """
    rmse = [episode.scores["rmse_mm"] for episode in episodes]
    strata = [stratum(episode) for episode in episodes]
    mean = mean_of(rmse, strata)
    summary: dict[str, Any] = {
        "episodes": len(episodes),
        "failed": sum(episode.failure is not None for episode in episodes),
        "goal_missed": sum(not reached(episode.scores, metrics) for episode in episodes),
        "rmse_mm": {
            "mean": mean.mean,
            "iqm": float(interquartile_mean(rmse)),
            "ci95": list(mean.ci95),
        },
        "vs_human": _vs_human(rmse, human_human, strata),
    }
    for name in metrics:
        if name != LEADING:
            summary[name] = _mean([episode.scores[name] for episode in episodes])
    times = np.array([t for episode in episodes for t in episode.step_times] or [math.nan])
    p50, p99 = 1000 * np.percentile(times, [50, 99])
    summary["step_ms"] = {"p50": _number(p50), "p99": _number(p99)}
    return summary


def _vs_human(
    rmse: Sequence[float], human_human: Sequence[float] | None, strata: Sequence[Stratum]
) -> dict[str, Any] | None:
    if human_human is None or len(human_human) != len(rmse):
        return None
    ratio = ratio_of_means(rmse, human_human, strata)
    return {"mean": ratio.mean, "ci95": list(ratio.ci95)}


def group(
    episodes: Sequence[Episode],
    metrics: Metrics,
    human_human: Mapping[Stratum, float] | None = None,
) -> list[dict[str, Any]]:
    """Return one entry for each behaviour and subject, in order of appearance.

    ``human_human`` is the mean RMSE of the human-human team in each stratum [mm], if it is known.
    """
    members: dict[Stratum, list[Episode]] = {}
    for episode in episodes:
        members.setdefault(stratum(episode), []).append(episode)
    return [
        {
            "behaviour": behaviour,
            "subject": subject,
            "episodes": len(some),
            "failed": sum(episode.failure is not None for episode in some),
            **{name: _mean([e.scores[name] for e in some]) for name in metrics},
            "human_human_rmse_mm": {"mean": (human_human or {}).get((behaviour, subject))},
        }
        for (behaviour, subject), some in members.items()
    ]


def _mean(values: Sequence[float]) -> dict[str, Any]:
    return dataclasses.asdict(mean_with_missing(values))


def _number(value: float) -> float | None:
    """Return a number that JSON knows: None for NaN."""
    return None if math.isnan(value) else float(value)
