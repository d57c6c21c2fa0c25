"""A robot that anticipates with a model in memory, wherever it was learned."""

import hashlib
from dataclasses import dataclass, field

from ...agents.agent import Agent
from ...agents.policies.anticipation import Anticipation, anticipation_json
from ...agents.policies.anticipation_controller import AnticipateParameters, AnticipationController
from ...agents.policies.in_process import InProcess


@dataclass(frozen=True, kw_only=True, eq=False)
class Foreseer(InProcess):
    """The control of :class:`.Anticipate` with a given model, as :class:`.AgentSpec`."""

    name: str
    model: Anticipation
    parameters: AnticipateParameters = field(default_factory=AnticipateParameters)

    def check(self) -> None:
        """Do nothing: its parts have checked themselves."""

    def digest(self) -> str:
        """Return a hash of model and parameters."""
        told = f"{anticipation_json(self.model)}{self.parameters}"
        return hashlib.sha256(told.encode()).hexdigest()[:16]

    def make(self) -> Agent:
        """Return a new robot."""
        return AnticipationController(self.model, self.parameters)
