"""Results of policies, of two people and of references on the same episodes."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Self

from colift.benchmark.channels import Channel
from colift.benchmark.episode.metric import LEADING, Metric, on_boards, second_axis
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL, reference_label
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.results.summary import StepTimes
from colift.benchmark.suites.suite import Suite


@dataclass(frozen=True, kw_only=True, eq=False)
class PolicyResults:
    """Scores of one policy, episode by episode. Traces are not kept: there are many policies."""

    name: str
    digest: str
    """Hash of the policy's source."""
    scores: ScoreTable
    step_ms: StepTimes

    @classmethod
    def of(cls, name: str, run: Run) -> Self:
        """Return the results of a run, under the name that tables use."""
        return cls(
            name=name,
            digest=run.policy_digest,
            scores=ScoreTable.of(run),
            step_ms=StepTimes.of(run),
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class PairedResults:
    """Results of policies, baseline and references on the same lifts, episode by episode."""

    suite: Suite
    policies: tuple[PolicyResults, ...]
    human_human: ScoreTable
    """Two people."""
    references: Mapping[str, ScoreTable] = field(default_factory=dict)
    """The references, by name."""
    channel: Channel | None = None
    """The channel between the robot and every policy; baseline and references have none."""

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
    def unranked(self) -> dict[str, ScoreTable]:
        """Two people, then the references, by label; none has a rank."""
        return {
            HUMAN_HUMAN_LABEL: self.human_human,
            **{reference_label(name): each for name, each in self.references.items()},
        }
