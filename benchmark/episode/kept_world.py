"""One world for the scenarios of a run, one after the other.

Making a new world takes as long as half a lift. Therefore one person replaces another in the same
world, bit for bit as in a new one (:class:`Shared`).
"""

import contextlib
from collections.abc import Iterator
from functools import partial
from typing import Final, NamedTuple, Protocol, Self, runtime_checkable

from colift.benchmark.episode.bodies import Bodies
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.task import Task
from colift.benchmark.world.human_body import BodyParameters
from colift.benchmark.world.interface import FarEnd, World
from colift.benchmark.world.table import Table


@runtime_checkable
class Shared(World, Protocol):
    """A world in which one person can replace another."""

    def with_person(self, human: BodyParameters) -> Self:
        """Exchange the person, and return the world, which must then be reset."""


class Left(NamedTuple):
    """A world that a lift has left."""

    task: Task
    bodies: Bodies
    world: World


_kept: Final[list[Left]] = []
"""The world left by the last lift."""


@contextlib.contextmanager
def lift_in_kept_world(scenario: Scenario) -> Iterator[Lift]:
    """Yield a lift, in the world of the last lift if only the person is another.

    Its world is left for the next one, unless an error ends the context.
    """
    lift = Lift(scenario, world=partial(_taken, _kept, scenario.task))
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
        _kept.pop().world.close()


def next_lift(lift: Lift, scenario: Scenario) -> Lift:
    """Return a lift of a scenario after another one, in the other's world if it can be used."""
    return Lift(scenario, world=partial(_taken, _left(lift), scenario.task))


def _taken(
    shelf: list[Left], task: Task, human: BodyParameters, far_end: FarEnd, table: Table
) -> World:
    """Return the world on a shelf with another person, or a new one if that cannot be."""
    if shelf:
        left = shelf.pop()
        same = (left.task, *left.bodies[1:]) == (task, far_end, table)
        if same and isinstance(left.world, Shared):
            return left.world.with_person(human)
        left.world.close()
    return task.world(human, far_end, table)


def _left(lift: Lift) -> list[Left]:
    """Return the world of a lift; nothing if it has none."""
    return [] if lift.bodies is None else [Left(lift.task, lift.bodies, lift.world)]


def _keep(lift: Lift) -> None:
    drop_kept_world()
    _kept.extend(_left(lift))
