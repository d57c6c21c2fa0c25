"""The bounds by name, and how each is played."""

from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from typing import Final

from ...agents.errors import InputError
from ..comparison.contest import Bound
from ..runner import Run, run_suite
from ..suite import Suite
from .causal import CAUSAL_BOUND, causal_bound
from .oracle import ORACLE, oracle_run


def causal_run(
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Run:
    """Return the causal bound's run on a suite; arguments as for :func:`.run_suite`.

    Raises
    ------
    InputError
        If the suite has another latency or control period than it was learned with.
    """
    bound = causal_bound()
    learned = bound.model.latency, bound.model.window.interval
    for scenario in suite.scenarios:
        found = scenario.latency, scenario.control_period
        if found != learned:
            raise InputError(
                f"{CAUSAL_BOUND} was learned with a latency and a control period of {learned} s, "
                f"{scenario.name} has {found} s; 'colift sweep' learns others"
            )
    return run_suite(bound, suite, executor=executor, progress=progress)


BOUNDS: Final[Mapping[str, Bound]] = {CAUSAL_BOUND: causal_run, ORACLE: oracle_run}
"""What `compare --bounds` shows. They are in no registry: no board can take them."""
