"""Has tasks played, alone or on any executor, and again if the machine fails."""

from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from dataclasses import dataclass
from typing import Final

from ..agents.errors import EvaluatorFault, InputError, told
from .episode import Episode
from .tasks import Task

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
            raise EvaluatorFault(f"tried {ATTEMPTS} times: {told(error)}") from error


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
        raise EvaluatorFault(f"cannot go on: {told(error)}") from error
