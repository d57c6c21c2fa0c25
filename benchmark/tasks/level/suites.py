"""The suites of colift itself."""

from collections.abc import Sequence

from colift.agents.humans import SUBJECTS
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.level.task import BEHAVIOURS


def standard_suite() -> Suite:
    """5 subjects x 4 behaviours x 15 lifts: the benchmark."""
    return _grid("standard-v1", BEHAVIOURS, 15)


def paper_suite() -> Suite:
    """5 subjects x 10 smooth lifts: the paper's Table I."""
    return _grid("paper-v1", ("smooth",), 10)


def quick_suite() -> Suite:
    """12 lifts, one stratum of each behaviour: a first look."""
    strata = zip(BEHAVIOURS, ("S1", "S2", "S3", "S5"), strict=True)
    scenarios = tuple(make_scenario(behaviour, subject) for behaviour, subject in strata)
    return Suite(name="quick-v1", scenarios=scenarios, seeds=(0, 1, 2))


def _grid(name: str, behaviours: Sequence[str], seeds: int) -> Suite:
    """Return the suite of every behaviour with every subject."""
    scenarios = tuple(
        make_scenario(behaviour, subject) for behaviour in behaviours for subject in SUBJECTS
    )
    return Suite(name=name, scenarios=scenarios, seeds=tuple(range(seeds)))
