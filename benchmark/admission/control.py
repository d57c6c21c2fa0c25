"""The negative control: a suite that hardly needs coordination, and must not be admitted."""

import dataclasses
from typing import Final

from colift.base.errors import InputError
from colift.benchmark.admission.played import LEAST_PEOPLE
from colift.benchmark.suites.suite import Suite, make_suite

CONTROL: Final = "standard-v1"
"""Name of the suite: a level table."""

CONTROL_PEOPLE: Final = 25
"""Its people who are played, as many as in the suites of the tasks with touch."""


def control_suite(people: int = CONTROL_PEOPLE) -> Suite:
    """Return the control, with its first people."""
    return first_people(make_suite(CONTROL), people)


def first_people(suite: Suite, count: int) -> Suite:
    """Return the lifts of a suite's first people; all of them, if there are no more.

    Raises
    ------
    InputError
        If the people are too few for a test.
    """
    if count < LEAST_PEOPLE:
        raise InputError(f"admission needs {LEAST_PEOPLE} people or more, got {count}")
    names = list(dict.fromkeys(each.subject.name for each in suite.scenarios))
    if len(names) <= count:
        return suite
    kept = tuple(each for each in suite.scenarios if each.subject.name in names[:count])
    return dataclasses.replace(suite, name=f"{suite.name} ({count} people)", scenarios=kept)
