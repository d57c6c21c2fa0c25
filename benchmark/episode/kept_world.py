"""One world for the scenarios of a run, one after the other.

Making a new world takes as long as half a lift. Therefore one person replaces another in the same
world, bit for bit as in a new one (:class:`Shared`).
"""

import contextlib
from collections.abc import Iterator
from functools import partial
from typing import Final, Protocol, Self, runtime_checkable

from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.task import Task
from colift.benchmark.world import BodyParameters, FarEnd, World


@runtime_checkable
class Shared(World, Protocol):
    """A world in which one person can replace another."""

    def with_person(self, human: BodyParameters) -> Self:
        """Exchange the person, and return the world, which must then be reset."""


_kept: Final[list[tuple[Task, FarEnd, World]]] = []
"""The world left by the last lift, with its task and the holder of its far end."""


@contextlib.contextmanager
def lift_in_kept_world(scenario: Scenario) -> Iterator[Lift]:
    """Yield a lift, in the world of the last lift if task and holder of the far end are the same.

    Its world is left for the next one, unless an error ends the context.
    """
    lift = Lift(scenario, world=partial(_taken, scenario.task))
    try:
        yield lift
    except GeneratorExit:  # No more episodes are requested.
        _keep(lift)
        raise
    except BaseException:
        lift.close()
        raise
    _keep(lift)


def drop_kept_world() -> None:
    """Release the world that is kept, if there is one: 30 MB."""
    while _kept:
        _kept.pop()[-1].close()


def next_lift(lift: Lift, scenario: Scenario) -> Lift:
    """Return a lift of a scenario after another one, in the other's world if it can be used."""
    left = (lift.task, lift.seat.body, lift.world)

    def world(human: BodyParameters, far_end: FarEnd) -> World:
        return _exchanged(left, scenario.task, human, far_end)

    return Lift(scenario, world=world)


def _exchanged(
    left: tuple[Task, FarEnd, World], task: Task, human: BodyParameters, far_end: FarEnd
) -> World:
    """Return the world that is left with another person, or a new one if that cannot be."""
    *setting, world = left
    if isinstance(world, Shared) and setting == [task, far_end]:
        return world.with_person(human)
    world.close()
    return task.world(human, far_end)


def _taken(task: Task, human: BodyParameters, far_end: FarEnd) -> World:
    if _kept:
        return _exchanged(_kept.pop(), task, human, far_end)
    return task.world(human, far_end)


def _keep(lift: Lift) -> None:
    drop_kept_world()
    _kept.append((lift.task, lift.seat.body, lift.world))
