"""Where an agent comes from."""

from contextlib import AbstractContextManager
from typing import Protocol

from ..agents.agent import Agent


class AgentSpec(Protocol):
    """Where the agent at the robot's end comes from; goes to worker processes, so it is pickled.

    :class:`colift.agents.policies.loading.PolicySpec` is one.
    """

    @property
    def name(self) -> str:
        """The agent's name, for tables."""

    @property
    def isolation(self) -> str:
        """What keeps the agent from the process that scores; ``none`` if it acts inside it."""

    def digest(self) -> str:
        """Return a hash of the agent's source."""

    def check(self) -> None:
        """Raise an InputError if there is no such agent."""

    def agent(self) -> AbstractContextManager[Agent]:
        """Return a context with a new agent, for one episode."""
