"""A small suite whose lifts are known by name: four behaviours, each with a subject of its own."""

from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.level.task import BEHAVIOURS

FOUR = Suite(
    name="four",
    scenarios=tuple(map(make_scenario, BEHAVIOURS, ("S1", "S2", "S3", "S5"))),
    seeds=(0, 1, 2),
)
