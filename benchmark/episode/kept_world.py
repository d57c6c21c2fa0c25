"""One world for the scenarios of a run, one after the other.

Making a new world takes as long as half a lift. Therefore one person replaces another in the same
world, bit for bit as in a new one (:class:`Shared`).
"""

import contextlib
from collections.abc import Iterator
from functools import partial
from typing import Final, Protocol, Self, runtime_checkable

from colift.benchmark.episode.lift import Lift, make_lift
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.task import Task
from colift.benchmark.world import BodyParameters, FarEnd, World

@runtime_checkable
class Shared(World, Protocol):
    """A world in which one person can replace another."""

    def with_person(self, human: BodyParameters) -> Self:
        """Exchange the person, and return the world, which must then be reset."""


_kept: Final[list[tuple[Task, FarEnd, Shared]]] = []
"""The world left by the last lift, with its task and the holder of its far end."""


@contextlib.contextmanager
def lift_in_kept_world(scenario: Scenario) -> Iterator[Lift]:
    """Yield a lift, in the world of the last lift if task and holder of the far end are the same.

    Its world is left for the next one, unless an error ends the context or it can have one person
    only.
    """
    lift = make_lift(scenario, world=partial(_taken, scenario.task))
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


def _taken(task: Task, human: BodyParameters, far_end: FarEnd) -> World:
    while _kept:
        kept, holder, world = _kept.pop()
        if (kept, holder) == (task, far_end):
            return world.with_person(human)
        world.close()
    return task.world(human, far_end)


def _keep(lift: Lift) -> None:
    drop_kept_world()
    if isinstance(lift.world, Shared):
        _kept.append((lift.task, lift.seat.body, lift.world))
    else:
        lift.close()
