"""The causal bound, learned from all observations."""

import hashlib
import re
from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Final

from colift.agents.agent import Agent
from colift.agents.control.recurrent import GatedNetwork, read_gated
from colift.agents.control.recurrent_controller import RecurrentController
from colift.agents.spec import InProcess
from colift.agents.tasks.touch.touch_controller import TouchController, read_touch
from colift.agents.tasks.touch.touch_law import TouchNetwork
from colift.base.errors import InputError
from colift.base.identity import code_hash
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY, Scenario
from colift.benchmark.execution.runner import Run, run_suite
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.level.task import LEVEL

CAUSAL_BOUND: Final = "causal_bound"

_NAME: Final = re.compile(r"causal_(\w+)\.npz")

BOUNDED: Final = tuple(
    sorted(
        found[1]
        for file in files(__package__).joinpath("data").iterdir()
        if (found := _NAME.fullmatch(file.name))
    )
)
"""Names of the tasks for which a causal bound was learned."""

LEARNED_TIMING: Final = (LATENCY, CONTROL_PERIOD)
"""Latency and control period with which the bound was learned [s]."""


@dataclass(frozen=True, kw_only=True)
class CausalBound(InProcess):
    """The causal bound of a task, as :class:`.AgentSpec`.

    It is an estimate, not a proof: the lowest known error of a policy with a policy's observations,
    at the paper's latency and control period. It has the equations of the task's learned policy
    (:class:`.Learned`, or :class:`.TouchController`), and was trained in the same way, by gradients
    through the twin's lifts, for the error alone: nothing was traded for smoothness, for people
    other than the benchmark's, or for other arms. The bound of a level table saw its own hand with
    0.1 mm of noise; a policy that relies on exact encoders may reach a lower error, but no robot
    has them.
    """

    name: str = CAUSAL_BOUND
    task: str = LEVEL.name
    """Name of the task."""

    def check(self) -> None:
        """Do nothing: the weights are shipped."""

    def digest(self) -> str:
        """Return a hash of the weights and of the equations."""
        weights = _weights(self.task).read_bytes()
        code = code_hash(RecurrentController if self.task == LEVEL.name else TouchController)
        return hashlib.sha256(weights + code.encode()).hexdigest()[:16]

    def make(self) -> Agent:
        """Return a new robot."""
        if self.task == LEVEL.name:
            return RecurrentController(causal_bound())
        return TouchController(touch_bound(self.task))


@cache
def causal_bound() -> GatedNetwork:
    """Return the network of the bound of the task ``level``."""
    return read_gated(_weights(LEVEL.name))


@cache
def touch_bound(task: str) -> TouchNetwork:
    """Return the network of the bound of a task with touch."""
    return read_touch(_weights(task))


def _weights(task: str) -> Traversable:
    return files(__package__).joinpath("data", f"causal_{task}.npz")


def timing(scenario: Scenario) -> tuple[float, float]:
    """Return latency and control period of a scenario [s]."""
    return scenario.latency, scenario.control_period


def has_causal_bound(suite: Suite) -> bool:
    """Return whether a bound was learned for the task and the timing of a suite."""
    known = suite.scenarios[0].task.name in BOUNDED
    return known and all(
        timing(each) == LEARNED_TIMING and each.conditions is None for each in suite.scenarios
    )


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
        If no bound was learned for the suite's task, or it was learned with another latency or
        control period.
    """
    task = suite.scenarios[0].task.name
    if task not in BOUNDED:
        raise InputError(
            f"no {CAUSAL_BOUND} was learned for the task {task!r}; known: {', '.join(BOUNDED)}"
        )
    for scenario in suite.scenarios:
        if scenario.conditions is not None:
            raise InputError(
                f"{CAUSAL_BOUND} was learned without conditions; {scenario.name} has "
                f"{scenario.conditions}"
            )
        if timing(scenario) != LEARNED_TIMING:
            raise InputError(
                f"{CAUSAL_BOUND} was learned with a latency and a control period of "
                f"{LEARNED_TIMING} s, {scenario.name} has {timing(scenario)} s"
            )
    return run_suite(CausalBound(task=task), suite, executor=executor, progress=progress)
