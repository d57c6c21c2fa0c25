"""The time that policies take to decide."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.spec import AgentSpec
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.execution.playing import play
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tasks.level.task import BEHAVIOURS

LIMIT_MS: Final = 10.0
"""Longest 99th percentile of a step [ms]: one motion-capture frame, a tenth of a control period.
The simulation waits for a policy, a real robot does not."""

SEEDS: Final = (0, 1)


@dataclass(frozen=True, kw_only=True)
class StepTime:
    """Durations of the steps of a policy."""

    policy: str
    steps: int
    """Steps that were timed."""
    median_ms: float
    p99_ms: float
    """99th percentile [ms]."""

    @property
    def within_limit(self) -> bool:
        """Whether the 99th percentile is at most ``LIMIT_MS``."""
        return self.p99_ms <= LIMIT_MS


def default_scenarios() -> tuple[Scenario, ...]:
    """Return one scenario of each behaviour."""
    return tuple(make_scenario(behaviour) for behaviour in BEHAVIOURS)


def step_time(
    policy: AgentSpec, scenarios: Sequence[Scenario], seeds: tuple[int, ...] = SEEDS
) -> StepTime | None:
    """Return the durations of the calls of ``act`` in whole episodes, in this process.

    The first episode is played once before the measurement, since loading is not part of a step.

    Parameters
    ----------
    policy
        The policy's specification.
    scenarios, seeds
        The episodes.

    Returns
    -------
    StepTime or None
        None if no step was completed, since the policy fails.

    Raises
    ------
    InputError
        If there is no such policy.
    """
    policy.check()
    list(play(policy, scenarios[0], seeds[:1]))
    times = [
        1000 * time
        for scenario in scenarios
        for episode in play(policy, scenario, seeds)
        for time in episode.step_times
    ]
    if not times:
        return None
    median, p99 = np.percentile(times, [50, 99])
    return StepTime(
        policy=policy.name, steps=len(times), median_ms=float(median), p99_ms=float(p99)
    )
