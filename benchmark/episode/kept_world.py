"""One world for the scenarios of a run, one after the other.

Making a new world takes as long as half a lift. Therefore one person replaces another in the same
world, bit for bit as in a new one (:class:`.SharedWorld`).
"""

import contextlib
from collections.abc import Iterator
from typing import Final

from colift.benchmark.episode.level import Level
from colift.benchmark.episode.lift import Lift, Staging, make_lift
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.world import BodyParameters, FarEnd
from colift.benchmark.world.shared_world import SharedWorld

_kept: Final[list[tuple[FarEnd, SharedWorld]]] = []
"""The world left by the last lift, with the holder of its far end."""


@contextlib.contextmanager
def lift_in_kept_world(scenario: Scenario) -> Iterator[Lift]:
    """Yield a lift, in the world of the last lift if the far end has the same holder.

    Its world is left for the next one, unless an error ends the context. A task with its own world
    or lift gets a new world.
    """
    task = scenario.task
    if isinstance(task, Staging) or type(task).world is not Level.world:
        with contextlib.closing(make_lift(scenario)) as lift:
            yield lift
        return
    lift = Lift(scenario, world=_taken)
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
        _kept.pop()[1].close()


def _taken(human: BodyParameters, far_end: FarEnd) -> SharedWorld:
    while _kept:
        holder, world = _kept.pop()
        if holder == far_end:
            return world.with_person(human, far_end)
        world.close()
    return SharedWorld(human, far_end)


def _keep(lift: Lift) -> None:
    drop_kept_world()
    assert isinstance(lift.world, SharedWorld)
    _kept.append((lift.seat.body, lift.world))
