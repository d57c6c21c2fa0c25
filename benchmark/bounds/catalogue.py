"""The bounds by name."""

from collections.abc import Mapping
from typing import Final

from colift.benchmark.bounds.causal import CAUSAL_BOUND, causal_run, has_causal_bound
from colift.benchmark.bounds.oracle import ORACLE, ORACLES, oracle_run
from colift.benchmark.bounds.told import TOLD, told_of, told_run
from colift.benchmark.comparison.playing import Bound
from colift.benchmark.suites.catalogue import PLAYED, RECORDED
from colift.benchmark.suites.suite import Suite

BOUNDS: Final[Mapping[str, Bound]] = {
    TOLD: told_run,
    CAUSAL_BOUND: causal_run,
    ORACLE: oracle_run,
}
"""The bounds by name. They are in no registry, so that no board can accept them."""


def suite_bounds(suite: Suite) -> Mapping[str, Bound]:
    """Return the bounds of a suite by name, as far as its task has them.

    The causal bound is left out if it was learned with another latency or control period, and for
    real lifts: it was learned from simulated people, and policies may be better with real ones.
    """
    first = suite.scenarios[0]
    real = first.behaviour in (RECORDED, PLAYED)
    known = {
        TOLD: told_of(suite) is not None,
        CAUSAL_BOUND: has_causal_bound(suite) and not real,
        ORACLE: first.task.name in ORACLES,
    }
    return {name: BOUNDS[name] for name, has in known.items() if has}
