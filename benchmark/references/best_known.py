"""The best known policy: a network that sees what a policy sees, trained for the error alone."""

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
from colift.benchmark.results.baselines import BEST_KNOWN
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.level.task import LEVEL

_NAME: Final = re.compile(r"best_known_(\w+)\.npz")

TRAINED: Final = tuple(
    sorted(
        found[1]
        for file in files(__package__).joinpath("data").iterdir()
        if (found := _NAME.fullmatch(file.name))
    )
)
"""Names of the tasks for which a best known policy was learned."""

LEARNED_TIMING: Final = (LATENCY, CONTROL_PERIOD)
"""Latency and control period with which the reference was learned [s]."""


@dataclass(frozen=True, kw_only=True)
class BestKnown(InProcess):
    """The best known policy of a task, as :class:`.AgentSpec`.

    It is no bound: it has the least error known so far with a policy's observations, at the suites'
    latency and control period, and whoever passes it becomes the reference. It has the equations of
    the task's learned policy (:class:`.Learned`, or :class:`.TouchController`), and was trained in
    the same way, by gradients through the twin's lifts, for the error and not for smoothness. In
    some tasks it is the shipped learned policy itself, whose people and arms were varied; one
    trained for the benchmark's people and arm alone may reach a lower error. That of a level table
    saw its own hand with 0.1 mm of noise; a policy that relies on exact encoders may reach a lower
    error, but no robot has them.
    """

    name: str = BEST_KNOWN
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
            return RecurrentController(level_network())
        return TouchController(touch_network(self.task))


@cache
def level_network() -> GatedNetwork:
    """Return the network of the reference of the task ``level``."""
    return read_gated(_weights(LEVEL.name))


@cache
def touch_network(task: str) -> TouchNetwork:
    """Return the network of the reference of a task with touch."""
    return read_touch(_weights(task))


def _weights(task: str) -> Traversable:
    return files(__package__).joinpath("data", f"best_known_{task}.npz")


def timing(scenario: Scenario) -> tuple[float, float]:
    """Return latency and control period of a scenario [s]."""
    return scenario.latency, scenario.control_period


def has_best_known(suite: Suite) -> bool:
    """Return whether a reference was learned for the task and the timing of a suite."""
    known = suite.scenarios[0].task.name in TRAINED
    return known and all(
        timing(each) == LEARNED_TIMING and each.conditions is None for each in suite.scenarios
    )


def best_known_run(
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Run:
    """Return the best known policy's run on a suite; arguments as for :func:`.run_suite`.

    Raises
    ------
    InputError
        If no reference was learned for the suite's task, or it was learned with another latency or
        control period.
    """
    task = suite.scenarios[0].task.name
    if task not in TRAINED:
        raise InputError(
            f"no {BEST_KNOWN} was learned for the task {task!r}; known: {', '.join(TRAINED)}"
        )
    for scenario in suite.scenarios:
        if scenario.conditions is not None:
            raise InputError(
                f"{BEST_KNOWN} was learned without conditions; {scenario.name} has "
                f"{scenario.conditions}"
            )
        if timing(scenario) != LEARNED_TIMING:
            raise InputError(
                f"{BEST_KNOWN} was learned with a latency and a control period of "
                f"{LEARNED_TIMING} s, {scenario.name} has {timing(scenario)} s"
            )
    return run_suite(BestKnown(task=task), suite, executor=executor, progress=progress)
