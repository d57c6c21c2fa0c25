"""Specifications of agents: their interfaces, and the base of those that act in this process."""

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Final, Protocol, Self, runtime_checkable

from colift.agents.agent import Agent, Remembering
from colift.agents.traced import traced
from colift.base.threads import one_thread

AUTO: Final = "auto"
"""Isolation of colift's own policies in this process, and of others in the strongest sandbox."""

NONE: Final = "none"
"""Isolation of what acts in the process that scores."""


class AgentSpec(Protocol):
    """The specification of the agent at the robot's end; picklable, as worker processes need it.

    :class:`colift.agents.loading.policy_spec.PolicySpec` is one.
    """

    @property
    def name(self) -> str:
        """The agent's name, for tables."""

    @property
    def isolation(self) -> str:
        """Isolation level of the agent; ``none`` if it acts in the process that scores."""

    def digest(self) -> str:
        """Return a hash of the agent's source."""

    def check(self) -> None:
        """Raise an InputError if there is no such agent."""

    def agent(self) -> AbstractContextManager[Agent]:
        """Return a context with a new agent, for one lift, or for the lifts of one session."""


@runtime_checkable
class Portable(AgentSpec, Protocol):
    """An agent that can be packaged for machines that do not share this one's files."""

    @property
    def files(self) -> Path | None:
        """The file or folder with the agent's own code; None if all of it is installed."""

    @property
    def module(self) -> str:
        """Name of the installed module with the agent's code, if ``digest`` returns a stored hash.

        Empty if ``digest`` reads the code itself, or if all code is in ``files``.
        """

    def moved(self, folder: Path) -> Self:
        """Return the same agent with its files in another folder."""


@runtime_checkable
class Paced(Protocol):
    """An agent with time budgets that follow from the control period."""

    def paced(self, period: float, lifts: int = 1) -> Self:
        """Return the same agent with the time budgets of a control period [s] and of many lifts."""


class InProcess:
    """Base of the specifications whose agents act in this process, without isolation."""

    @property
    def isolation(self) -> str:
        """Isolation level: none."""
        return "none"

    def make(self) -> Agent:
        """Return a new agent."""
        raise NotImplementedError

    @contextmanager
    def agent(self) -> Iterator[Agent]:
        """Yield a new agent for one session, with :func:`one_thread` and its errors traced."""
        with one_thread():
            agent = self.make()
            if isinstance(agent, Remembering):
                agent.begin_session()
            with one_thread():  # It may have loaded another library.
                yield traced(agent)
