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
from ...agents.touch.touch_controller import TouchController, read_touch
from ...agents.touch.touch_law import TouchNetwork
from ..comparison.playing import Bound
from ..episode.level import LEVEL
from ..episode.scenario import CONTROL_PERIOD, LATENCY
from ..execution.runner import Run, run_suite
from ..suites.suite import Suite
from .oracle import ORACLE, ORACLES, oracle_run

CAUSAL_BOUND: Final = "causal_bound"


@dataclass(frozen=True, kw_only=True)
class CausalBound(InProcess):
    """The causal bound of a task, as :class:`.AgentSpec`.

    It is an estimate, not a proof: the lowest error known of a policy with a policy's observation,
    the paper's latency and control period. It has the equations of :class:`.Learned`, in tasks with
    touch those of :func:`.felt_action`, and was trained in the same way, by gradients through the
    twin's lifts, for the error alone: nothing was given away for smoothness, for other people than
    the benchmark's, or for other arms.
    """

    name: str = CAUSAL_BOUND
    task: str = LEVEL.name

    def check(self) -> None:
        """Do nothing: the weights are shipped."""

    def digest(self) -> str:
        """Return a hash of the weights."""
        return hashlib.sha256(_weights(self.task).read_bytes()).hexdigest()[:16]

    def make(self) -> Agent:
        """Return a new robot."""
        if self.task == LEVEL.name:
            return RecurrentController(causal_bound())
        return TouchController(touch_bound(self.task))


@cache
def causal_bound() -> GatedNetwork:
    """Return the network of the bound of a level table that is shipped."""
    return read_gated(_weights(LEVEL.name))


@cache
def touch_bound(task: str) -> TouchNetwork:
    """Return the network of the bound of a task with touch that is shipped."""
    return read_touch(_weights(task))


def _weights(task: str) -> Traversable:
    return files(__package__).joinpath("data", f"causal_bound_{task}.npz")


def _is_learned(task: str) -> bool:
    return _weights(task).is_file()


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
    bound = CausalBound(task=suite.scenarios[0].task.name)
    return run_suite(bound, suite, executor=executor, progress=progress)


BOUNDS: Final[Mapping[str, Bound]] = {CAUSAL_BOUND: causal_run, ORACLE: oracle_run}
"""All bounds."""


def suite_bounds(suite: Suite) -> Mapping[str, Bound]:
    """Return the bounds of a suite's task by name; none if it has none.

    They are in no registry: no board can take them.
    """
    task = suite.scenarios[0].task.name
    known = {CAUSAL_BOUND: _is_learned(task), ORACLE: task in ORACLES}
    return {name: bound for name, bound in BOUNDS.items() if known[name]}
