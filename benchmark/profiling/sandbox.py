"""The cost of isolation, relative to the same policy in this process."""

import contextlib
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from colift.agents.sandbox.host.levels import working_levels
from colift.agents.sandbox.host.policy import SandboxedPolicy
from colift.agents.spec import AgentSpec
from colift.agents.submissions.new import write_template
from colift.agents.submissions.submission import read_submission
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.turns import policy_seed
from colift.benchmark.suites.catalogue import make_scenario

STEP_US: Final = 60.0
"""Largest aimed cost of a step [us]."""

EPISODE_MS: Final = 30.0
"""Largest aimed cost of an episode [ms]."""

ROUNDS: Final = 20
"""Pairs of episodes, one in this process and one isolated."""


@dataclass(frozen=True, kw_only=True)
class IsolationCost:
    """Cost of an isolation level, relative to none."""

    step_us: float
    """Added time per step [us]."""
    episode_ms: float
    """Added time per episode without its steps [ms]: making the policy, its reset, its end."""

    @property
    def within_aim(self) -> bool:
        """Whether both costs are within the aims."""
        return self.step_us <= STEP_US and self.episode_ms <= EPISODE_MS


@contextlib.contextmanager
def isolated() -> Iterator[tuple[AgentSpec, dict[str, SandboxedPolicy]]]:
    """Yield the template of a submission, in this process and at each level that works here."""
    with tempfile.TemporaryDirectory(prefix="colift-") as directory:
        folder = Path(directory, "template")
        write_template(folder)
        submission = read_submission(folder)
        policies = {level: submission.sandboxed(level) for level in working_levels()}
        yield submission.trusted(), policies


def isolation_cost(
    plain: AgentSpec,
    policy: AgentSpec,
    rounds: int = ROUNDS,
    progress: Callable[[int], None] = lambda rounds: None,
) -> IsolationCost:
    """Return the cost of isolation: medians of the differences in paired episodes.

    Parameters
    ----------
    plain
        The policy in this process.
    policy
        The same policy, isolated.
    rounds
        Pairs of episodes.
    progress
        Called with the number of rounds that were finished since the last call.
    """
    steps, episodes = [], []
    with contextlib.closing(Lift(make_scenario("smooth"))) as lift:
        for spec in (plain, policy):
            _once(lift, spec, 0)
        for seed in range(rounds):
            (step, episode), (more, longer) = (_once(lift, each, seed) for each in (plain, policy))
            steps.append(more - step)
            episodes.append(longer - episode)
            progress(1)
    return IsolationCost(
        step_us=1e6 * statistics.median(steps), episode_ms=1e3 * statistics.median(episodes)
    )


def _once(lift: Lift, policy: AgentSpec, seed: int) -> tuple[float, float]:
    """Return the median time of a step in an episode, and the episode's time without steps [s]."""
    with policy.agent() as agent:
        times = run_episode(lift, agent, seed).step_times
    begin = time.perf_counter()
    with policy.agent() as agent:
        agent.reset(policy_seed())
    return statistics.median(times), time.perf_counter() - begin
