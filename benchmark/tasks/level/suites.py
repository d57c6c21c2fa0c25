"""The suites of the task to keep the table level."""

from colift.agents.humans import SUBJECTS
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.people import people_suite
from colift.benchmark.suites.ranges import QUICK_PEOPLE, STANDARD_PEOPLE
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.level.task import BEHAVIOURS, Level


def standard_suite() -> Suite:
    """75 people x 4 behaviours: the benchmark."""
    return people_suite("standard-v1", Level.name, BEHAVIOURS, STANDARD_PEOPLE)


def quick_suite() -> Suite:
    """3 people x 4 behaviours: a first look."""
    return people_suite("quick-v1", Level.name, BEHAVIOURS, QUICK_PEOPLE)


def paper_suite() -> Suite:
    """5 subjects x 10 smooth lifts: the paper's Table I."""
    scenarios = tuple(make_scenario("smooth", subject) for subject in SUBJECTS)
    return Suite(name="paper-v1", scenarios=scenarios, seeds=tuple(range(10)))
