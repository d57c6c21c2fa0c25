"""Units of work, a few lifts each, played alone or on any executor."""

import contextlib
import dataclasses
import itertools
import time
from collections.abc import Container, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from dataclasses import dataclass
from typing import Final

from colift.agents.agent import Action, Agent, Observation
from colift.agents.spec import AgentSpec, Paced
from colift.base.errors import EvaluatorFault, InputError, error_text
from colift.benchmark.channels import Channel
from colift.benchmark.channels.teleoperated import teleoperated
from colift.benchmark.episode.blame import blaming_plugins, check_episode, check_start
from colift.benchmark.episode.kept_world import drop_kept_world
from colift.benchmark.episode.loop import Episode, run_episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.suites.hidden import keyed
from colift.benchmark.suites.suite import Due, Suite, alike
from colift.benchmark.tasks.worlds import played_lift

LIFTS_PER_BATCH: Final = 5
"""Lifts that a worker plays at a time: few enough for visible progress."""


@dataclass(frozen=True, kw_only=True)
class Batch:
    """A worker's unit of work: some of a suite's lifts."""

    policy: AgentSpec
    lifts: tuple[Due, ...]
    channel: Channel | None = None
    """The channel between the robot and the policy; None if there is none."""

    def play(self) -> Iterator[tuple[int, Episode]]:
        """Yield the place and the episode of each lift; see :func:`play`."""
        for scenario, some in alike(self.lifts):
            seeds = tuple(due.seed for due in some)
            episodes = play(self.policy, scenario, seeds, self.channel)
            yield from zip([due.place for due in some], episodes, strict=True)

    def __call__(self) -> list[tuple[int, Episode]]:
        """Return all of :meth:`play`; worker processes run this."""
        return list(self.play())

    def without(self, done: Container[int]) -> "Batch":
        """Return the batch without the places in ``done``."""
        left = tuple(due for due in self.lifts if due.place not in done)
        return dataclasses.replace(self, lifts=left)


def play(
    policy: AgentSpec,
    scenario: Scenario,
    seeds: tuple[int, ...],
    channel: Channel | None = None,
) -> Iterator[Episode]:
    """Play the scenario with each seed, with a new policy object for each episode.

    A channel is outside the policy's sandbox.

    Raises
    ------
    EvaluatorFault
        If the machine failed.
    InputError
        If the task or the behaviour of another package failed, or broke one of its rules.
    """
    if isinstance(policy, Paced):
        policy = policy.paced(scenario.control_period)
    with contextlib.ExitStack() as kept:
        with blaming_plugins(scenario, seeds[0]):
            lift = kept.enter_context(played_lift(scenario))
            check_start(lift, seeds[0])
        for seed in seeds:
            with contextlib.ExitStack() as stack:
                begin = time.perf_counter()
                agent = entered(stack, policy)
                made = time.perf_counter() - begin
                if channel is not None:
                    agent = teleoperated(agent, channel, scenario, seed)
                with blaming_plugins(scenario, seed):
                    episode = run_episode(lift, agent, seed)
                    check_episode(lift, episode)
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


def entered(stack: contextlib.ExitStack, policy: AgentSpec) -> Agent:
    """Return a new agent of a policy; leaving the stack closes it.

    The agent of a policy that cannot be made fails at its reset, with the same error.
    """
    try:
        return stack.enter_context(policy.agent())
    except EvaluatorFault:
        raise
    except (Exception, SystemExit) as error:
        return _Unmade(error)


def batches(
    policy: AgentSpec,
    suite: Suite,
    done: Container[int] = (),
    channel: Channel | None = None,
) -> Iterator[Batch]:
    """Yield the rest of a suite: all episodes but those with a place in ``done``."""
    for first in range(0, suite.size, LIFTS_PER_BATCH):
        places = range(first, min(first + LIFTS_PER_BATCH, suite.size))
        lifts = tuple(suite.at(index) for index in places if index not in done)
        if lifts:
            yield Batch(policy=policy, lifts=lifts, channel=channel)


def shuffled_batches(
    policy: AgentSpec,
    suite: Suite,
    secret: bytes,
    done: Container[int] = (),
    channel: Channel | None = None,
) -> Iterator[Batch]:
    """Yield the rest of a suite, one episode per batch, in an order that follows from a secret.

    The position of an episode then does not reveal which one it is, and the order for one policy
    reveals nothing about the order for another.
    """
    labels = ("order", policy.name, policy.digest(), suite.digest)

    def lot(index: int) -> bytes:
        return keyed(secret, *labels, index)

    for index in sorted((index for index in range(suite.size) if index not in done), key=lot):
        yield Batch(policy=policy, lifts=(suite.at(index),), channel=channel)


ATTEMPTS: Final = 3
"""Attempts at a batch before the machine counts as broken."""


@dataclass
class Faults:
    """A counter of the machine's failures."""

    count: int = 0

    def add(self, attempt: int, error: BaseException) -> None:
        """Count a failure in the n-th attempt at a batch.

        Raises
        ------
        EvaluatorFault
            If that was the last attempt.
        """
        self.count += 1
        if attempt >= ATTEMPTS:
            raise EvaluatorFault(f"tried {ATTEMPTS} times: {error_text(error)}") from error


AHEAD: Final = 4
"""Batches that an executor has at a time for each of its workers, done, in work or waiting."""

UNKNOWN_WORKERS: Final = 256
"""Workers of an executor that has no attribute ``workers``: rather too many than idle ones."""


def run_batches(
    batches: Iterable[Batch], executor: Executor | None, faults: Faults
) -> Iterator[tuple[int, Episode]]:
    """Yield the place of each episode, and the episode, as it is finished.

    Parameters
    ----------
    batches
        The episodes to play.
    executor
        Plays the batches; None plays them here, one after the other. Its attribute ``workers``,
        if it has one, is the number of batches that it plays at a time.
    faults
        Counts the failed attempts.

    Raises
    ------
    EvaluatorFault
        If the machine failed in :data:`ATTEMPTS` attempts at a batch, or the executor accepts no
        more calls.
    InputError
        As :func:`play`, or if a worker has another origin; see :func:`.cluster.call`.
    """
    return _alone(batches, faults) if executor is None else _pooled(batches, executor, faults)


def _alone(batches: Iterable[Batch], faults: Faults) -> Iterator[tuple[int, Episode]]:
    try:
        for batch in batches:
            done: set[int] = set()
            attempt = 1
            while len(done) < len(batch.lifts):
                try:
                    for index, episode in batch.without(done).play():
                        done.add(index)
                        yield index, episode
                except EvaluatorFault as error:
                    faults.add(attempt, error)
                    attempt += 1
    finally:
        drop_kept_world()


def _pooled(
    batches: Iterable[Batch], executor: Executor, faults: Faults
) -> Iterator[tuple[int, Episode]]:
    waiting: dict[Future[list[tuple[int, Episode]]], tuple[Batch, int]] = {}
    left = iter(batches)
    try:
        while True:
            most = AHEAD * max(1, getattr(executor, "workers", UNKNOWN_WORKERS))
            for batch in itertools.islice(left, max(0, most - len(waiting))):
                waiting[_submitted(batch, executor)] = batch, 1
            if not waiting:
                return
            for future in wait(waiting, return_when=FIRST_COMPLETED).done:
                batch, attempt = waiting.pop(future)
                try:
                    played = future.result()
                except InputError:
                    raise
                except Exception as error:
                    faults.add(attempt, error)
                    waiting[_submitted(batch, executor)] = batch, attempt + 1
                else:
                    yield from played
    finally:
        for future in waiting:
            future.cancel()


def _submitted(batch: Batch, executor: Executor) -> Future[list[tuple[int, Episode]]]:
    """Return the future of a batch; an executor that refuses it counts as broken."""
    try:
        return executor.submit(batch)
    except Exception as error:
        raise EvaluatorFault(f"cannot continue: {error_text(error)}") from error
