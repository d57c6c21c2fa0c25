"""Suites of drawn people."""

from collections.abc import Sequence
from dataclasses import replace

from colift.agents.humans import Subject
from colift.base.errors import InputError
from colift.benchmark.episode.conditions import Conditions
from colift.benchmark.episode.scenario import LATENCY
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.ranges import LEARNING_PEOPLE
from colift.benchmark.suites.suite import Suite


def people_suite(
    name: str,
    task: str,
    behaviours: Sequence[str],
    people: range,
    lifts: int = 1,
    conditions: Conditions | None = None,
    latency: float = LATENCY,
) -> Suite:
    """Return a suite in which each drawn person plays all behaviours.

    Plan and noise of a lift follow from its seed and the scenario's name, which has the person.

    Parameters
    ----------
    name
        Name of the suite.
    task
        Name of a registered task.
    behaviours
        Names of registered behaviours.
    people
        Numbers of the people, who are ``draw-K``.
    lifts
        Number of lifts of each person with each behaviour: the seeds 0, 1, ...
    conditions
        Ranges of what is drawn for each lift; see :attr:`.Scenario.conditions`.
    latency
        Age of the robot's samples [s].

    Raises
    ------
    InputError
        If a person is one to learn from, or as :class:`.Suite`.
    """
    taken = [each for each in people if each in LEARNING_PEOPLE]
    if taken:
        raise InputError(
            f"suite {name!r} has draw-{taken[0]}: numbers {LEARNING_PEOPLE[0]} to "
            f"{LEARNING_PEOPLE[-1]} are people to learn from"
        )
    subjects = [Subject.draw(person) for person in people]
    scenarios = tuple(
        replace(made, subject=subject, conditions=conditions, latency=latency)
        for made in (make_scenario(behaviour, task=task) for behaviour in behaviours)
        for subject in subjects
    )
    return Suite(name=name, scenarios=scenarios, seeds=tuple(range(lifts)))
