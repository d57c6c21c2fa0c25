"""The bounds by name."""

from collections.abc import Mapping
from typing import Final

from ..comparison.playing import Bound
from ..suites.suite import Suite
from .causal import BOUNDED, CAUSAL_BOUND, causal_run
from .oracle import ORACLE, ORACLES, oracle_run

BOUNDS: Final[Mapping[str, Bound]] = {CAUSAL_BOUND: causal_run, ORACLE: oracle_run}
"""The bounds by name. They are in no registry: no board can take them."""


def suite_bounds(suite: Suite) -> Mapping[str, Bound]:
    """Return the bounds of a suite's task by name; none if it has none."""
    task = suite.scenarios[0].task.name
    known = {CAUSAL_BOUND: task in BOUNDED, ORACLE: task in ORACLES}
    return {name: BOUNDS[name] for name, has in known.items() if has}
