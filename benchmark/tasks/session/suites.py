"""The suite of ten lifts with the same person."""

from typing import Final

from colift.benchmark.suites.people import people_suite
from colift.benchmark.suites.ranges import SESSION_PEOPLE
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.level.task import Level

LIFTS: Final = 10
"""Lifts of a session."""

LATE: Final = 0.2
"""Age of the robot's samples [s], twice that of the other suites: foresight counts."""


def session_suite() -> Suite:
    """40 people x 10 lifts in a row: who remembers them has the last three right."""
    return people_suite(
        "session-v1", Level.name, ("habitual",), SESSION_PEOPLE, lifts=LIFTS, latency=LATE
    )
