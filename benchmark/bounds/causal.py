"""The causal bound, learned from all that can be seen, and the bounds by name."""

import hashlib
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Final

from ...agents.agent import Agent
from ...agents.control.recurrent import GatedNetwork, read_gated
from ...agents.control.recurrent_controller import RecurrentController
from ...agents.errors import InputError
from ...agents.spec import InProcess
from ..comparison.playing import Bound
from ..episode.level import LEVEL
from ..episode.scenario import CONTROL_PERIOD, LATENCY
from ..execution.runner import Run, run_suite
from ..suites.suite import Suite
from .oracle import ORACLE, ORACLES, oracle_run

CAUSAL_BOUND: Final = "causal_bound"


@dataclass(frozen=True, kw_only=True)
class CausalBound(InProcess):
    """The causal bound, as :class:`.AgentSpec`.

    It is an estimate, not a proof: the lowest error known of a policy with a policy's observation,
    the paper's latency and control period. It has the equations of :class:`.Learned`, and was
    trained in the same way, by gradients through the twin's lifts, for the error alone: nothing was
    given away for smoothness, for other people than the benchmark's, or for other arms.
    """

    name: str = CAUSAL_BOUND

    def check(self) -> None:
        """Do nothing: the weights are shipped."""

    def digest(self) -> str:
        """Return a hash of the weights."""
        return hashlib.sha256(_weights().read_bytes()).hexdigest()[:16]

    def make(self) -> Agent:
        """Return a new robot."""
        return RecurrentController(causal_bound())


@cache
def causal_bound() -> GatedNetwork:
    """Return the network of the bound that is shipped."""
    return read_gated(_weights())


def _weights() -> Traversable:
    return files(__package__).joinpath("data", "causal_bound.npz")


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
    learned = LATENCY, CONTROL_PERIOD
    for scenario in suite.scenarios:
        found = scenario.latency, scenario.control_period
        if found != learned:
            raise InputError(
                f"{CAUSAL_BOUND} was learned with a latency and a control period of {learned} s, "
                f"{scenario.name} has {found} s"
            )
    return run_suite(CausalBound(), suite, executor=executor, progress=progress)


BOUNDS: Final[Mapping[str, Bound]] = {CAUSAL_BOUND: causal_run, ORACLE: oracle_run}
"""The bounds of the task ``level``."""


def suite_bounds(suite: Suite) -> Mapping[str, Bound]:
    """Return the bounds of a suite's task by name; none if it has none.

    They are in no registry: no board can take them. The causal bound has been learned for the task
    ``level``; any task with an oracle has that.
    """
    task = suite.scenarios[0].task.name
    if task == LEVEL.name:
        return BOUNDS
    return {ORACLE: oracle_run} if task in ORACLES else {}
