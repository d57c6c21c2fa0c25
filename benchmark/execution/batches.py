"""Units of work, a few lifts each, played alone or on any executor."""

import dataclasses
import itertools
from collections.abc import Container, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from dataclasses import dataclass
from typing import Final

from colift.agents.spec import AgentSpec
from colift.base.errors import EvaluatorFault, InputError, error_text
from colift.benchmark.channels import Channel
from colift.benchmark.episode.kept_world import drop_kept_world
from colift.benchmark.episode.loop import Episode
from colift.benchmark.execution.playing import play, play_session
from colift.benchmark.execution.sessions import is_session
from colift.benchmark.suites.hidden import keyed
from colift.benchmark.suites.suite import Due, Suite, alike

LIFTS_PER_BATCH: Final = 5
"""Lifts that a worker plays at a time: few enough for visible progress."""


@dataclass(frozen=True, kw_only=True)
class Batch:
    """A worker's unit of work: some of a suite's lifts, or a session."""

    policy: AgentSpec
    lifts: tuple[Due, ...]
    done: frozenset[int] = frozenset()
    """Places of lifts of a session that are known: they are played again for what is remembered of
    them, and not returned."""
    channel: Channel | None = None
    """The channel between the robot and the policy; None if there is none."""

    def play(self) -> Iterator[tuple[int, Episode]]:
        """Yield the place and the episode of each lift; see :func:`.play`."""
        if is_session(self.lifts):
            episodes = play_session(self.policy, self.lifts, self.channel)
            for due, episode in zip(self.lifts, episodes, strict=True):
                if due.place not in self.done:
                    yield due.place, episode
            return
        for scenario, some in alike(self.lifts):
            seeds = tuple(due.seed for due in some)
            episodes = play(self.policy, scenario, seeds, self.channel)
            yield from zip([due.place for due in some], episodes, strict=True)

    def __call__(self) -> list[tuple[int, Episode]]:
        """Return all of :meth:`play`; worker processes run this."""
        return list(self.play())

    @property
    def size(self) -> int:
        """Number of the lifts that it returns."""
        return len(self.lifts) - len(self.done)

    def without(self, done: Container[int]) -> "Batch":
        """Return the batch without the places in ``done``; a session is always played whole."""
        if is_session(self.lifts):
            known = frozenset(due.place for due in self.lifts if due.place in done)
            return dataclasses.replace(self, done=self.done | known)
        left = tuple(due for due in self.lifts if due.place not in done)
        return dataclasses.replace(self, lifts=left)


def batches(
    policy: AgentSpec,
    suite: Suite,
    done: Container[int] = (),
    channel: Channel | None = None,
) -> Iterator[Batch]:
    """Yield the rest of a suite: all episodes but those with a place in ``done``."""
    for batch in _divided(policy, suite, channel, LIFTS_PER_BATCH):
        left = batch.without(done)
        if left.size:
            yield left


def _divided(
    policy: AgentSpec, suite: Suite, channel: Channel | None, most: int
) -> Iterator[Batch]:
    """Yield all of a suite, in its order: a session at a time, or at most some lifts."""
    size = suite.session or most
    for first in range(0, suite.size, size):
        places = range(first, min(first + size, suite.size))
        lifts = tuple(suite.at(index) for index in places)
        yield Batch(policy=policy, lifts=lifts, channel=channel)


def shuffled_batches(
    policy: AgentSpec,
    suite: Suite,
    secret: bytes,
    done: Container[int] = (),
    channel: Channel | None = None,
) -> Iterator[Batch]:
    """Yield the rest of a suite, a lift or a session per batch, in an order by a secret.

    The position of an episode then does not reveal which one it is, and the order for one policy
    reveals nothing about the order for another.
    """
    labels = ("order", policy.name, policy.digest(), suite.digest)

    def lot(batch: Batch) -> bytes:
        return keyed(secret, *labels, batch.lifts[0].place)

    for batch in sorted(_divided(policy, suite, channel, 1), key=lot):
        left = batch.without(done)
        if left.size:
            yield left


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
            while len(done) < batch.size:
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
