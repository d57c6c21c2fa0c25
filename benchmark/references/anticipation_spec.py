"""The control of `anticipate` with a model other than the shipped one."""

import hashlib
from dataclasses import dataclass, field

from colift.agents.agent import Agent
from colift.agents.control.anticipation import Anticipation, anticipation_json
from colift.agents.policies.anticipate import AnticipateParameters, AnticipationController
from colift.agents.spec import InProcess


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
