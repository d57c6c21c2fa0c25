"""Where an agent comes from: the interface of specifications, and agents made in this process."""

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import Protocol, Self, runtime_checkable

from threadpoolctl import threadpool_limits

from .agent import Agent


class AgentSpec(Protocol):
    """Where the agent at the robot's end comes from; goes to worker processes, so it is pickled.

    :class:`colift.agents.loading.loading.PolicySpec` is one.
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


@runtime_checkable
class Paced(Protocol):
    """An agent with time budgets that follow from the control period."""

    def paced(self, period: float) -> Self:
        """Return the same agent with the budgets of a control period [s]."""


@contextmanager
def one_thread() -> Iterator[None]:
    """Give linear algebra one thread, as it has in a sandbox: their number changes last bits.

    It holds for the libraries that are loaded at the beginning.
    """
    with threadpool_limits(limits=1):
        yield


class InProcess:
    """The part of a specification that makes its agents in this process, without isolation."""

    @property
    def isolation(self) -> str:
        """What keeps the agent apart: nothing."""
        return "none"

    def make(self) -> Agent:
        """Return a new agent."""
        raise NotImplementedError

    @contextmanager
    def agent(self) -> Iterator[Agent]:
        """Yield a new agent for one episode, with :func:`one_thread`."""
        with one_thread():
            agent = self.make()
            with one_thread():  # It may have loaded another library.
                yield agent
