"""Agents that act inside the process that scores: ours, and foreign ones that are trusted."""

from collections.abc import Iterator
from contextlib import contextmanager

from ..agent import Agent


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
        """Yield a new agent for one episode."""
        yield self.make()
