"""The causal bound, learned from all that can be seen, and the bounds by name."""

import hashlib
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from typing import Final

from ...agents.agent import Agent
from ...agents.control.anticipation import Anticipation, anticipation_json, read_anticipation
from ...agents.errors import InputError
from ...agents.policies.anticipate import AnticipateParameters, AnticipationController
from ...agents.spec import InProcess
from ..comparison.playing import Bound
from ..execution.runner import Run, run_suite
from ..suites.suite import Suite
from .oracle import ORACLE, oracle_run


@dataclass(frozen=True, kw_only=True, eq=False)
class AnticipationSpec(InProcess):
    """The control of :class:`.Anticipate` with a given model, as :class:`.AgentSpec`."""

    name: str
    model: Anticipation
    parameters: AnticipateParameters = field(default_factory=AnticipateParameters)

    def check(self) -> None:
        """Do nothing: its parts have checked themselves."""

    def digest(self) -> str:
        """Return a hash of model and parameters."""
        content = f"{anticipation_json(self.model)}{self.parameters}"
        return hashlib.sha256(content.encode()).hexdigest()[:16]

    def make(self) -> Agent:
        """Return a new robot."""
        return AnticipationController(self.model, self.parameters)


CAUSAL_BOUND: Final = "causal_bound"

FIRST_SEED: Final = 150_000
"""Seed of the first lift that it learns from: other people and lifts than those of the policy."""

LIFTS: Final = 2400
"""Lifts that it learns from, in one round: its robot has anticipated from the first."""

HIDDEN: Final = (128, 128, 128)
"""Units of its hidden layers: twice the policy's, so more than three times the weights."""

ONLY_LEVEL: Final = AnticipateParameters(smoothness=0.0)
"""A bound of the error alone: it trades none of it for smoothness."""


@cache
def causal_bound() -> AnticipationSpec:
    """Return the bound that is shipped, for the paper's latency and control period.

    It is an estimate, not a proof: what a larger network than the policy's learns in the same way,
    from other lifts, with nothing given away for smoothness.
    """
    text = files(__package__).joinpath("data", "causal_bound.json")
    return AnticipationSpec(
        name=CAUSAL_BOUND, model=read_anticipation(text.read_text()), parameters=ONLY_LEVEL
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
