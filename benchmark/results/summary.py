"""The summary of a run: from episodes to the numbers of a results table."""

import dataclasses
import functools
from array import array
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from colift.benchmark.episode.episode import Episode
from colift.benchmark.episode.metric import LEADING, Metrics, reached
from colift.benchmark.statistics import (
    Estimate,
    MeanWithMissing,
    interquartile_mean,
    mean_of,
    mean_with_missing,
    ratio_of_means,
)

Stratum = tuple[str, str]
"""Behaviour and subject."""


@dataclass(frozen=True, kw_only=True)
class StepTimes:
    """Percentiles of a policy's time per step, over all steps [ms]; None if it never acted."""

    p50: float | None
    p99: float | None

    @classmethod
    def of(cls, episodes: Iterable[Episode]) -> Self:
        """Return the percentiles over all steps of the episodes.

        A long run has millions of steps: they are in single precision, and sorted in place.
        """
        times = array("f")
        for episode in episodes:
            times.extend(episode.step_times)
        if not times:
            return cls(p50=None, p99=None)
        found = np.percentile(np.frombuffer(times, np.float32), [50, 99], overwrite_input=True)
        p50, p99 = (1000 * float(each) for each in found)
        return cls(p50=p50, p99=p99)


@dataclass(frozen=True, kw_only=True)
class Summary:
    """The numbers of a run."""

    episodes: int
    failed: int
    goal_missed: int
    """Episodes in which the human did not reach the intended height."""
    rmse_mm: Estimate
    rmse_mm_iqm: float
    """Interquartile mean of the RMSE [mm]."""
    vs_human: Estimate | None
    """Mean RMSE divided by that of the human-human baseline; None without this baseline."""
    metrics: Mapping[str, MeanWithMissing]
    """The other metrics by name."""
    step_ms: StepTimes
    real_time: bool | None = None
    """Whether the policy keeps up with a real robot; None if it never acted."""

    def plain(self) -> dict[str, Any]:
        """Return the summary, ready for JSON."""
        return {
            "episodes": self.episodes,
            "failed": self.failed,
            "goal_missed": self.goal_missed,
            "rmse_mm": {
                "mean": self.rmse_mm.mean,
                "iqm": self.rmse_mm_iqm,
                "ci95": list(self.rmse_mm.ci95),
            },
            "vs_human": None if self.vs_human is None else plain_estimate(self.vs_human),
            **_plain_means(self.metrics),
            "step_ms": dataclasses.asdict(self.step_ms),
            "real_time": self.real_time,
        }


@dataclass(frozen=True, kw_only=True)
class StratumScores:
    """The means of a run in one stratum."""

    behaviour: str
    subject: str
    episodes: int
    failed: int
    metrics: Mapping[str, MeanWithMissing]
    """All metrics by name."""
    human_human_rmse_mm: float | None
    """Mean RMSE of the human-human baseline [mm]; None without this baseline."""

    def plain(self) -> dict[str, Any]:
        """Return the scores, ready for JSON."""
        return {
            "behaviour": self.behaviour,
            "subject": self.subject,
            "episodes": self.episodes,
            "failed": self.failed,
            **_plain_means(self.metrics),
            "human_human_rmse_mm": {"mean": self.human_human_rmse_mm},
        }


def plain_estimate(estimate: Estimate) -> dict[str, Any]:
    """Return an estimate, ready for JSON."""
    return {"mean": estimate.mean, "ci95": list(estimate.ci95)}


def _plain_means(metrics: Mapping[str, MeanWithMissing]) -> dict[str, Any]:
    return {name: dataclasses.asdict(mean) for name, mean in metrics.items()}


def stratum(episode: Episode) -> Stratum:
    """Return the behaviour and the subject of an episode: its stratum."""
    return _pair(episode.behaviour, episode.subject)


@functools.lru_cache
def _pair(behaviour: str, subject: str) -> Stratum:
    # The same object for all lifts of a stratum, of which there may be thousands.
    return behaviour, subject


def summarise(
    episodes: Sequence[Episode], metrics: Metrics, human_human: Sequence[float] | None = None
) -> Summary:
    """Return the summary of a policy's episodes.

    The interval of ``rmse_mm`` is by bootstrap over the episodes within each stratum. The other
    metrics have the mean over the episodes with a value and the number of those without one
    (``missing``): a policy that does not move has no smoothness, and ranks last by it.

    Parameters
    ----------
    episodes
        The policy's episodes.
    metrics
        The metrics of the task.
    human_human
        RMSE of the human-human baseline on the same episodes [mm]. With it, ``vs_human`` is the
        ratio of the means, with the 95 % interval of a bootstrap that pairs the episodes: 1 is as
        good as a human partner, less is better. Without it, ``vs_human`` is None.
    """
    rmse = [episode.scores["rmse_mm"] for episode in episodes]
    strata = [stratum(episode) for episode in episodes]
    return Summary(
        episodes=len(episodes),
        failed=sum(episode.failure is not None for episode in episodes),
        goal_missed=sum(not reached(episode.scores, metrics) for episode in episodes),
        rmse_mm=mean_of(rmse, strata),
        rmse_mm_iqm=float(interquartile_mean(rmse)),
        vs_human=None
        if human_human is None or len(human_human) != len(rmse)
        else ratio_of_means(rmse, human_human, strata),
        metrics={name: mean_score(episodes, name) for name in metrics if name != LEADING},
        step_ms=StepTimes.of(episodes),
    )


def by_stratum(
    episodes: Sequence[Episode],
    metrics: Metrics,
    human_human: Mapping[Stratum, float] | None = None,
) -> tuple[StratumScores, ...]:
    """Return the scores of each stratum, in order of appearance.

    ``human_human`` is the mean RMSE of the human-human baseline in each stratum [mm], if known.
    """
    members: dict[Stratum, list[Episode]] = {}
    for episode in episodes:
        members.setdefault(stratum(episode), []).append(episode)
    return tuple(
        StratumScores(
            behaviour=behaviour,
            subject=subject,
            episodes=len(some),
            failed=sum(episode.failure is not None for episode in some),
            metrics={name: mean_score(some, name) for name in metrics},
            human_human_rmse_mm=(human_human or {}).get((behaviour, subject)),
        )
        for (behaviour, subject), some in members.items()
    )


def mean_score(episodes: Sequence[Episode], name: str) -> MeanWithMissing:
    """Return the mean of a metric over the episodes that have it."""
    return mean_with_missing([episode.scores[name] for episode in episodes])
