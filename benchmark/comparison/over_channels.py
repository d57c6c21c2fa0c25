"""The price of a channel: each policy on the same lifts, with and without it."""

from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass

from colift.agents.spec import AgentSpec
from colift.benchmark.channels import Channel
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.statistics import Estimate
from colift.benchmark.suites.suite import Suite


@dataclass(frozen=True, kw_only=True)
class OverChannel:
    """A policy's error over one channel."""

    policy: str
    channel: str | None
    """Name of the channel; None for no channel."""
    rmse_mm: Estimate
    price_mm: Estimate
    """Paired difference to the policy's error without a channel; 0 for no channel."""
    failed: int
    """Failed lifts."""


def over_channels(
    policies: Mapping[str, AgentSpec],
    channels: Mapping[str, Channel],
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Iterator[OverChannel]:
    """Yield the errors of each policy: without a channel, then over each of them.

    The plans, the noise and the losses of channels with the same loss and burst are those of the
    same lift, so that the differences are paired.

    Parameters
    ----------
    policies, channels
        Policies and channels, by the names that tables use.
    suite, executor, progress
        As for :func:`.run_suite`.
    """
    played: list[tuple[str | None, Channel | None]] = [(None, None), *channels.items()]
    for name, spec in policies.items():
        alone: ScoreTable | None = None
        for of, channel in played:
            run = run_suite(spec, suite, executor=executor, progress=progress, channel=channel)
            scores = ScoreTable.of(run)
            alone = alone or scores
            yield OverChannel(
                policy=name,
                channel=of,
                rmse_mm=scores.error,
                price_mm=scores.against(alone).difference,
                failed=scores.failed,
            )
