"""The summary of a run: from episodes to the numbers of a results table."""

import dataclasses
from array import array
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from colift.benchmark.episode.metric import LEADING, reached
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.roughness import rougher
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.results.strata import plain_means
from colift.benchmark.statistics import Estimate, Interval, MeanWithMissing, interquartile_mean


@dataclass(frozen=True, kw_only=True)
class StepTimes:
    """Percentiles of a policy's time per step, over all steps [ms]; None if it never acted."""

    p50: float | None = None
    p99: float | None = None

    @classmethod
    def of(cls, run: Run) -> Self:
        """Return the percentiles of a run.

        A long run has millions of steps: they are in single precision, and sorted in place.
        """
        times = array("f")
        for episode in run.episodes:
            times.extend(episode.step_times)
        if not times:
            return cls()
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
    """RMSE divided by that of two people, geometric mean over the lifts; None without
    this baseline."""
    rougher: tuple[str, ...] | None
    """Metrics by which the policy is rougher than two people, see :func:`.rougher`;
    None if that is not known."""
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
                "ci95": plain_interval(self.rmse_mm.ci95),
            },
            "vs_human": None if self.vs_human is None else plain_estimate(self.vs_human),
            "rougher": None if self.rougher is None else list(self.rougher),
            **plain_means(self.metrics),
            "step_ms": dataclasses.asdict(self.step_ms),
            "real_time": self.real_time,
        }


def plain_estimate(estimate: Estimate) -> dict[str, Any]:
    """Return an estimate, ready for JSON."""
    return {"mean": estimate.mean, "ci95": plain_interval(estimate.ci95)}


def plain_interval(ci95: Interval | None) -> list[float] | None:
    """Return an interval, ready for JSON; None where there is none."""
    return None if ci95 is None else list(ci95)


def summarise(run: Run, scores: ScoreTable, human_human: ScoreTable | None = None) -> Summary:
    """Return the summary of a policy's run.

    Intervals are between people, each with all of their lifts. The other
    metrics have the mean over the episodes with a value and the number of those without one
    (``missing``): a policy that does not move has no smoothness, and ranks last by it.

    Parameters
    ----------
    run, scores
        The run and its scores.
    human_human
        Two people on the same episodes. With it, ``vs_human`` is the geometric mean
        of the ratio of the two RMSE, lift by lift, with its 95 % interval: 1 is as good as a human
        partner, less is better. Without it, or if only a part of the episodes has been played,
        ``vs_human`` is None.
    """
    if human_human is not None and len(human_human.strata) != len(scores.strata):
        human_human = None
    return Summary(
        episodes=len(run.episodes),
        failed=scores.failed,
        goal_missed=sum(not reached(each.scores, run.suite.metrics) for each in run.episodes),
        rmse_mm=scores.error,
        rmse_mm_iqm=interquartile_mean(scores.rmse_mm),
        vs_human=None if human_human is None else scores.against(human_human).ratio,
        rougher=None if human_human is None else rougher(scores, human_human, run.suite.metrics),
        metrics={name: scores.metric(name) for name in scores.values if name != LEADING},
        step_ms=StepTimes.of(run),
    )
