"""The references by name."""

from collections.abc import Mapping
from typing import Final

from colift.benchmark.comparison.playing import Reference
from colift.benchmark.references.best_known import best_known_run, has_best_known
from colift.benchmark.references.oracle import ORACLE, ORACLES, oracle_run
from colift.benchmark.references.told import TOLD, told_of, told_run
from colift.benchmark.results.baselines import BEST_KNOWN
from colift.benchmark.suites.catalogue import REAL
from colift.benchmark.suites.suite import Suite

REFERENCES: Final[Mapping[str, Reference]] = {
    TOLD: told_run,
    BEST_KNOWN: best_known_run,
    ORACLE: oracle_run,
}
"""The references by name. They are in no registry, so that no board can accept them."""


def suite_references(suite: Suite) -> Mapping[str, Reference]:
    """Return the references of a suite by name, as far as its task has them.

    The best known policy is left out if it was learned with another latency or control period,
    and for real lifts: it was trained for simulated people, and is not the best known with real
    ones.
    """
    first = suite.scenarios[0]
    known = {
        TOLD: told_of(suite) is not None,
        BEST_KNOWN: has_best_known(suite) and first.behaviour not in REAL,
        ORACLE: first.task.name in ORACLES,
    }
    return {name: REFERENCES[name] for name, has in known.items() if has}
