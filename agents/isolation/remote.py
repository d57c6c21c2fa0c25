"""A policy in a cell, as an agent."""

import math
from typing import Any, NoReturn

import numpy as np

from ..agent import Action, Observation
from ..errors import PolicyError
from .connection import Connection
from .limits import REASON, Limits
from .output import clean
from .processor import Caller
from .server import INTERNALS, NAME


class UnmadeAgent:
    """An agent whose policy could not be made: its reset says why.

    Parameters
    ----------
    failure
        Why.
    printed
        What was printed meanwhile.
    """

    def __init__(self, failure: PolicyError, printed: str) -> None:
        self.failure = failure
        self.printed = printed

    def reset(self, seed: int) -> None:
        """Raise the failure."""
        raise self.failure

    def act(self, observation: Observation) -> Action:
        """Raise the failure."""
        raise self.failure


class RemoteAgent:
    """An agent whose policy runs elsewhere. What fails there is a :class:`.PolicyError` here.

    Parameters
    ----------
    connection
        Where the policy is.
    limits
        What it may take.
    size
        How many numbers its action is.
    """

    def __init__(self, connection: Connection, limits: Limits, size: int) -> None:
        self._connection = connection
        self._limits = limits
        self._size = size
        self._caller = Caller()
        self.failure: PolicyError | None = None
        """Why the policy could not be made, or failed."""

    def close(self) -> None:
        """Let this thread run on any processor again."""
        self._caller.free()

    @property
    def printed(self) -> str:
        """The last 10,000 characters of what the policy has printed in this episode."""
        return self._connection.output.text

    def reset(self, seed: int) -> None:
        """Begin an episode.

        Raises
        ------
        PolicyError
            If the policy could not be made, or fails.
        EvaluatorFault
            If the sandbox fails.
        """
        self._asked(["reset", seed], "ready", self._limits.start_seconds)

    def act(self, observation: Observation) -> Action:
        """Return the policy's action.

        Raises
        ------
        PolicyError, EvaluatorFault
            As :meth:`reset`, or if the action is not the finite numbers that it must be.
        """
        request = ["act", self._caller.begin(), observation.tolist()]
        content = self._asked(request, "action", self._limits.step_seconds)
        self._caller.end()
        numbers, names, values = (*content, None, None, None)[:3]
        if (
            type(numbers) is not list
            or len(numbers) != self._size
            or not all(type(number) is float and math.isfinite(number) for number in numbers)
        ):
            self._fail(f"sent an action that is not {self._size} finite number(s)")
        self._keep(names, values)
        return np.array(numbers)

    def _keep(self, names: Any, values: Any) -> None:
        """Take in the internals behind an action; this agent has none."""

    def _asked(self, request: list[Any], kind: str, seconds: float) -> list[Any]:
        """Return the content of the answer to a request."""
        if self.failure is not None:
            raise self.failure
        try:
            told, *content = self._connection.request(request, seconds)
        except PolicyError as error:
            self.failure = error
            raise
        if told == "failed" and len(content) == 1 and type(content[0]) is str:
            self._fail(content[0])
        if told != kind:
            self._fail(f"answered {told!r:.40} where {kind!r} was due")
        return content

    def _fail(self, reason: str) -> NoReturn:
        self.failure = PolicyError(clean(reason)[:REASON])
        raise self.failure from None


class ExplainingRemoteAgent(RemoteAgent):
    """A remote agent whose policy says what its actions were based on."""

    _internals: dict[str, float] | None = None

    def internals(self) -> dict[str, float]:
        """Return what the last action was based on."""
        return dict(self._internals or {})

    def _keep(self, names: Any, values: Any) -> None:
        sound = (
            type(names) is list
            and type(values) is list
            and len(names) == len(values) <= INTERNALS
            and all(type(name) is str and len(name) <= NAME for name in names)
            and all(type(value) is float and not math.isinf(value) for value in values)
        )
        if not sound:
            self._fail("its internals are not names and finite numbers")
        self._internals = dict(zip(map(clean, names), values, strict=True))


def remote_agent(connection: Connection, limits: Limits, size: int) -> RemoteAgent:
    """Return the agent for a connection; if its policy cannot be made, its reset says why.

    Raises
    ------
    EvaluatorFault
        If the sandbox fails.
    """
    agent = RemoteAgent(connection, limits, size)
    try:
        explains = agent._asked(["make"], "made", limits.start_seconds)
    except PolicyError:
        return agent
    if explains == [True]:
        return ExplainingRemoteAgent(connection, limits, size)
    return agent
