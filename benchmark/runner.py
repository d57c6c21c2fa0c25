"""Runs a policy through a suite, alone or on any executor."""

import itertools
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Executor, Future, as_completed
from dataclasses import dataclass
from typing import Protocol

from ..agents.agent import Action, Agent, Observation
from .episode import Episode, run_episode
from .lift import Lift
from .scenario import Scenario
from .suite import Suite

SEEDS_PER_TASK = 5
"""Seeds of one scenario that a worker plays at a time: few enough that progress shows, many
enough that building the world (some milliseconds) does not."""


class AgentSpec(Protocol):
    """Where the agent at the robot's end comes from; goes to worker processes, so it is pickled.

    :class:`colift.agents.policies.loading.PolicySpec` is one.
    """

    @property
    def name(self) -> str:
        """The agent's name, for tables."""

    def digest(self) -> str:
        """Return a hash of the agent's source."""

    def check(self) -> None:
        """Raise an InputError if there is no such agent."""

    def make(self) -> Agent:
        """Return a new agent."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Run:
    """A policy's episodes on a suite, in the suite's order: scenarios, then seeds."""

    policy: str
    """The policy's name."""
    policy_digest: str
    """Hash of the policy's source."""
    suite: Suite
    episodes: tuple[Episode, ...]

    @property
    def complete(self) -> bool:
        """Whether every episode of the suite is there."""
        return len(self.episodes) == self.suite.size


def play(policy: AgentSpec, scenario: Scenario, seeds: tuple[int, ...]) -> Iterator[Episode]:
    """Play the scenario with each seed, with a new policy object for each episode."""
    lift = Lift(scenario)
    try:
        for seed in seeds:
            yield run_episode(lift, _made(policy), seed)
    finally:
        lift.close()


class _Unmade:
    """Stands in for an agent whose constructor failed: fails in the same way at the reset."""

    def __init__(self, error: BaseException) -> None:
        self._error = error

    def reset(self, seed: int) -> None:
        raise self._error

    def act(self, observation: Observation) -> Action:
        raise self._error


def _made(policy: AgentSpec) -> Agent:
    try:
        return policy.make()
    except (Exception, SystemExit) as error:
        return _Unmade(error)


def _task(policy: AgentSpec, scenario: Scenario, seeds: tuple[int, ...]) -> list[Episode]:
    """Return the episodes of :func:`play`; what a worker process runs."""
    return list(play(policy, scenario, seeds))


def run_suite(
    policy: AgentSpec,
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Run:
    """Evaluate a policy on a suite.

    The result depends on the policy and the suite only: not on the executor, its workers or the
    order in which they finish.

    Parameters
    ----------
    policy
        Where the policy's class is.
    suite
        The episodes.
    executor
        Runs the tasks, at most its own number at a time; None runs everything in this process.
    progress
        Called with the number of episodes that were finished since the last call.

    Returns
    -------
    Run
        All episodes; or, after Ctrl-C, those that were finished by then.

    Raises
    ------
    InputError
        If the policy cannot be loaded.
    """
    policy.check()
    seeds = [
        suite.seeds[i : i + SEEDS_PER_TASK] for i in range(0, len(suite.seeds), SEEDS_PER_TASK)
    ]
    tasks = list(itertools.product(suite.scenarios, seeds))
    done: dict[int, list[Episode]] = {}
    try:
        if executor is None:
            for index, (scenario, chunk) in enumerate(tasks):
                done[index] = []
                for episode in play(policy, scenario, chunk):
                    done[index].append(episode)
                    progress(1)
        else:
            _gather(policy, tasks, executor, done, progress)
    except KeyboardInterrupt:
        pass
    episodes = tuple(episode for index in sorted(done) for episode in done[index])
    return Run(policy=policy.name, policy_digest=policy.digest(), suite=suite, episodes=episodes)


def _gather(
    policy: AgentSpec,
    tasks: list[tuple[Scenario, tuple[int, ...]]],
    executor: Executor,
    done: dict[int, list[Episode]],
    progress: Callable[[int], None],
) -> None:
    """Submit all tasks and collect their episodes into ``done`` as they finish."""
    futures: dict[Future[list[Episode]], int] = {
        executor.submit(_task, policy, scenario, chunk): index
        for index, (scenario, chunk) in enumerate(tasks)
    }
    try:
        for future in as_completed(futures):
            done[futures[future]] = future.result()
            progress(len(done[futures[future]]))
    except (KeyboardInterrupt, CancelledError):
        for future in futures:
            future.cancel()
        raise
