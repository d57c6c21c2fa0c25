"""Lifts in worlds that one person after another uses."""

import contextlib
from collections.abc import Iterator

from colift.benchmark.episode.kept_world import lift_in_kept_world, next_lift
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.task import Task
from colift.benchmark.tasks.level.task import Level
from colift.benchmark.tasks.touch import Touch


def takes_anybody(task: Task) -> bool:
    """Return whether one person can replace another in the worlds of a task.

    A task that makes worlds of its own may change the people in them, and one with parameters that
    cannot be compared may not be the same from lift to lift.
    """
    try:
        hash(task)
    except TypeError:
        return False
    return type(task).world in (Level.world, Touch.world)


@contextlib.contextmanager
def played_lift(scenario: Scenario) -> Iterator[Lift]:
    """Yield a lift, in the world of the last one if that can be."""
    if takes_anybody(scenario.task):
        with lift_in_kept_world(scenario) as lift:
            yield lift
    else:
        with contextlib.closing(Lift(scenario)) as lift:
            yield lift


def lift_after(lift: Lift, scenario: Scenario) -> Lift:
    """Return a lift of a scenario after another one, in the other's world if that can be."""
    if takes_anybody(scenario.task):
        return next_lift(lift, scenario)
    lift.close()
    return Lift(scenario)
