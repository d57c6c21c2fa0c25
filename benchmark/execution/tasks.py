"""Units of work, a few seeds of one scenario each, played alone or on any executor."""

import contextlib
import dataclasses
import time
from collections.abc import Container, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from dataclasses import dataclass
from typing import Final

from ...agents.agent import Action, Agent, Observation
from ...agents.errors import EvaluatorFault, InputError, error_text
from ...agents.spec import AgentSpec, Paced
from ..episode.episode import Episode, run_episode
from ..episode.lift import Lift
from ..episode.scenario import Scenario
from ..suites.hidden import keyed
from ..suites.suite import Suite

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

    def play(self) -> Iterator[tuple[int, Episode]]:
        """Yield the place and the episode of each seed; see :func:`play`."""
        episodes = play(self.policy, self.scenario, self.seeds)
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


def play(policy: AgentSpec, scenario: Scenario, seeds: tuple[int, ...]) -> Iterator[Episode]:
    """Play the scenario with each seed, with a new policy object for each episode.

    Raises
    ------
    EvaluatorFault
        If the machine failed.
    """
    if isinstance(policy, Paced):
        policy = policy.paced(scenario.control_period)
    with contextlib.closing(Lift(scenario)) as lift:
        for seed in seeds:
            with contextlib.ExitStack() as stack:
                begin = time.perf_counter()
                agent = _entered(stack, policy)
                made = time.perf_counter() - begin
                episode = run_episode(lift, agent, seed)
                taken = made + episode.policy_time
                yield dataclasses.replace(episode, policy_time=taken)


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


def tasks(policy: AgentSpec, suite: Suite, done: Container[int] = ()) -> list[Task]:
    """Return what is left to play of a suite: no episode whose place is in ``done``."""
    found = []
    size = len(suite.seeds)
    for row in range(len(suite.scenarios)):
        for first in range(0, size, SEEDS_PER_TASK):
            columns = range(first, min(first + SEEDS_PER_TASK, size))
            task = _task(policy, suite, row, columns)
            found.append(task.without(done))
    return [task for task in found if task.places]


def shuffled_tasks(
    policy: AgentSpec, suite: Suite, secret: bytes, done: Container[int] = ()
) -> list[Task]:
    """Return the same, each episode a task of its own, in an order that follows from a secret.

    By the number of an episode nobody then knows which one it is, and from the order of one policy
    nothing follows about that of another.
    """
    labels = ("order", policy.name, policy.digest(), suite.digest)

    def lot(place: int) -> bytes:
        return keyed(secret, *labels, place)

    size = len(suite.seeds)
    places = sorted((place for place in range(suite.size) if place not in done), key=lot)
    return [_task(policy, suite, place // size, (place % size,)) for place in places]


def _task(policy: AgentSpec, suite: Suite, row: int, columns: Sequence[int]) -> Task:
    """Return some episodes of a scenario as a task."""
    return Task(
        policy=policy,
        scenario=suite.scenarios[row],
        seeds=tuple(suite.seeds[column] for column in columns),
        places=tuple(row * len(suite.seeds) + column for column in columns),
    )


ATTEMPTS: Final = 3
"""How often a task is tried before the machine is given up."""


@dataclass
class Faults:
    """Counts the times that the machine has failed."""

    count: int = 0

    def add(self, attempt: int, error: BaseException) -> None:
        """Count one, in the n-th attempt of a task.

        Raises
        ------
        EvaluatorFault
            If that was the last attempt.
        """
        self.count += 1
        if attempt >= ATTEMPTS:
            raise EvaluatorFault(f"tried {ATTEMPTS} times: {error_text(error)}") from error


def gather(
    tasks: Sequence[Task], executor: Executor | None, faults: Faults
) -> Iterator[tuple[int, Episode]]:
    """Yield the place and the episode of everything that is played, as it is finished.

    Parameters
    ----------
    tasks
        What to play.
    executor
        Plays the tasks; None plays them here, one after the other.
    faults
        Counts the tasks that had to be tried again.

    Raises
    ------
    EvaluatorFault
        If a task failed :data:`ATTEMPTS` times and it was not the policy's fault, or the executor
        takes no more.
    InputError
        If a worker is of another origin; see :func:`.parcels.call`.
    """
    return _alone(tasks, faults) if executor is None else _pooled(tasks, executor, faults)


def _alone(tasks: Sequence[Task], faults: Faults) -> Iterator[tuple[int, Episode]]:
    for task in tasks:
        done: set[int] = set()
        attempt = 1
        while len(done) < len(task.places):
            try:
                for place, episode in task.without(done).play():
                    done.add(place)
                    yield place, episode
            except EvaluatorFault as error:
                faults.add(attempt, error)
                attempt += 1


def _pooled(
    tasks: Sequence[Task], executor: Executor, faults: Faults
) -> Iterator[tuple[int, Episode]]:
    waiting: dict[Future[list[tuple[int, Episode]]], tuple[Task, int]] = {}
    try:
        for task in tasks:
            waiting[_submitted(task, executor)] = task, 1
        while waiting:
            for future in wait(waiting, return_when=FIRST_COMPLETED).done:
                task, attempt = waiting.pop(future)
                try:
                    played = future.result()
                except InputError:
                    raise
                except Exception as error:
                    faults.add(attempt, error)
                    waiting[_submitted(task, executor)] = task, attempt + 1
                else:
                    yield from played
    finally:
        for future in waiting:
            future.cancel()


def _submitted(task: Task, executor: Executor) -> Future[list[tuple[int, Episode]]]:
    """Return the future of a task; an executor that does not take it is at its end."""
    try:
        return executor.submit(task)
    except Exception as error:
        raise EvaluatorFault(f"cannot go on: {error_text(error)}") from error
