"""Results of policies, of the human-human baseline and of bounds on the same episodes."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from colift.benchmark.channels import Channel
from colift.benchmark.episode.metric import LEADING, Metric, Scores, on_boards, second_axis
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL, Baseline
from colift.benchmark.results.summary import StepTimes, Stratum, stratum
from colift.benchmark.suites.suite import Suite


@dataclass(frozen=True, kw_only=True, eq=False)
class PolicyResults:
    """Scores of one policy, episode by episode. Traces are not kept: there are many policies."""

    name: str
    digest: str
    """Hash of the policy's source."""
    strata: tuple[Stratum, ...]
    """Behaviour and subject of each episode, in the suite's order."""
    scores: tuple[Scores, ...]
    failures: tuple[str | None, ...]
    """Reason of each failure; None for an episode that did not fail."""
    step_ms: tuple[float, float] | None
    """Median and 99th percentile of the time of a step [ms]; None if it never made one."""

    @classmethod
    def of(cls, name: str, run: Run) -> "PolicyResults":
        """Return the results of a run, under the name that tables use."""
        times = StepTimes.of(run.episodes)
        return cls(
            name=name,
            digest=run.policy_digest,
            strata=tuple(stratum(episode) for episode in run.episodes),
            scores=tuple(episode.scores for episode in run.episodes),
            failures=tuple(episode.failure for episode in run.episodes),
            step_ms=None if times.p50 is None or times.p99 is None else (times.p50, times.p99),
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class PairedResults:
    """Results of policies, baseline and bounds on the same lifts, episode by episode."""

    suite: Suite
    policies: tuple[PolicyResults, ...]
    human_human: Baseline
    """The human-human baseline."""
    bounds: Mapping[str, Baseline] = field(default_factory=dict)
    """The bounds, by name."""
    channel: Channel | None = None
    """The channel between the robot and every policy; baseline and bounds have none."""

    @property
    def metrics(self) -> tuple[Metric, ...]:
        """The metrics that are compared beside RMSE."""
        return on_boards(self.suite.metrics)

    @property
    def axes(self) -> tuple[Metric, Metric]:
        """The leading metric and the one beside it in pictures."""
        metrics = self.suite.metrics
        return metrics[LEADING], second_axis(metrics)

    @property
    def references(self) -> dict[str, Baseline]:
        """The human-human baseline, then the bounds, by name; none has a rank."""
        return {HUMAN_HUMAN_LABEL: self.human_human, **self.bounds}
