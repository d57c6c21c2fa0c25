"""What a worker plays at a time."""

import contextlib
import dataclasses
from collections.abc import Container, Iterator
from dataclasses import dataclass
from typing import Final

from ..agents.agent import Action, Agent, Observation
from ..agents.errors import EvaluatorFault
from .agent_spec import AgentSpec
from .episode import Episode, run_episode
from .lift import Lift
from .scenario import Scenario
from .suite import Suite

SEEDS_PER_TASK: Final = 5
"""Seeds of one scenario that a worker plays at a time: few enough that progress shows, many
enough that building the world (some milliseconds) does not."""


@dataclass(frozen=True, kw_only=True)
class Task:
    """What a worker plays at a time: some of a suite's episodes, all of one scenario."""

    policy: AgentSpec
    scenario: Scenario
    seeds: tuple[int, ...]
    places: tuple[int, ...]
    """Where in the suite each episode is, counted from 0."""
    key: bytes
    """The key of the policy's seed."""

    def play(self) -> Iterator[tuple[int, Episode]]:
        """Yield the place and the episode of each seed; see :func:`play`."""
        episodes = play(self.policy, self.scenario, self.seeds, key=self.key)
        return zip(self.places, episodes, strict=True)

    def __call__(self) -> list[tuple[int, Episode]]:
        """Return all of :meth:`play`: what a worker process runs."""
        return list(self.play())

    def without(self, done: Container[int]) -> "Task":
        """Return the task without the places in ``done``."""
        left = [i for i, place in enumerate(self.places) if place not in done]
        return dataclasses.replace(
            self,
            seeds=tuple(self.seeds[i] for i in left),
            places=tuple(self.places[i] for i in left),
        )


def play(
    policy: AgentSpec, scenario: Scenario, seeds: tuple[int, ...], *, key: bytes = b""
) -> Iterator[Episode]:
    """Play the scenario with each seed, with a new policy object for each episode.

    Raises
    ------
    EvaluatorFault
        If the machine failed.
    """
    with contextlib.closing(Lift(scenario)) as lift:
        for seed in seeds:
            with contextlib.ExitStack() as stack:
                yield run_episode(lift, _entered(stack, policy), seed, key=key)


class _Unmade:
    """Stands in for an agent whose constructor failed: fails in the same way at the reset."""

    def __init__(self, error: BaseException) -> None:
        self._error = error

    def reset(self, seed: int) -> None:
        raise self._error

    def act(self, observation: Observation) -> Action:
        raise self._error


def _entered(stack: contextlib.ExitStack, policy: AgentSpec) -> Agent:
    try:
        return stack.enter_context(policy.agent())
    except EvaluatorFault:
        raise
    except (Exception, SystemExit) as error:
        return _Unmade(error)


def tasks(
    policy: AgentSpec, suite: Suite, done: Container[int] = (), key: bytes = b""
) -> list[Task]:
    """Return what is left to play of a suite: no episode whose place is in ``done``."""
    found = []
    size = len(suite.seeds)
    for row, scenario in enumerate(suite.scenarios):
        for first in range(0, size, SEEDS_PER_TASK):
            columns = range(first, min(first + SEEDS_PER_TASK, size))
            task = Task(
                policy=policy,
                scenario=scenario,
                seeds=tuple(suite.seeds[column] for column in columns),
                places=tuple(row * size + column for column in columns),
                key=key,
            )
            found.append(task.without(done))
    return [task for task in found if task.places]
