"""The suite of one policy for all, told nothing."""

from typing import Final

from colift.benchmark.episode.conditions import Conditions
from colift.benchmark.suites.people import people_suite
from colift.benchmark.suites.ranges import ROBUST_PEOPLE
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.level.task import Level

BEHAVIOURS: Final = ("wait", "dip", "stop", "turn_back", "follow", "waltz", "double_pump")
"""The behaviours of people; nothing is trained on the last two."""

CONDITIONS: Final = Conditions(
    latency=(0.0, 0.3),
    jitter=(0.0, 0.02),
    loss=(0.0, 0.3),
    burst=(1.0, 15.0),
    noise=(1.0, 4.0),
    table=(0.2, 0.7),
    stiffness=(0.7, 1.4),
    damping=(0.7, 1.4),
    sag=(0.5, 2.0),
    gain=(0.6, 1.2),
)
"""The conditions of a lift. The ranges are chosen, not measured: from a fresh sample to
the 0.3 s of a satellite link, and a table of up to what the NAO's two arms can hold."""


def robust_suite() -> Suite:
    """40 people x 7 behaviours, delays, tables and arms unknown: one policy for all."""
    return people_suite("robust-v1", Level.name, BEHAVIOURS, ROBUST_PEOPLE, conditions=CONDITIONS)
