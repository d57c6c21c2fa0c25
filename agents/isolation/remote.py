"""A policy in a cell, as an agent."""

import math
from typing import Any, NoReturn

import numpy as np

from ..actions import ActionError, checked_action
from ..agent import Action, Observation
from ..errors import EvaluatorFault, PolicyError
from .connection import Connection
from .limits import REASON, Limits
from .output import clean
from .server import INTERNALS, NAME


class RemoteAgent:
    """An agent whose policy runs elsewhere. What fails there is a :class:`.PolicyError` here.

    Parameters
    ----------
    connection
        Where the policy is; None if there is none.
    limits
        What it may take.
    size
        How many numbers its action is.
    failure
        Why there is none.
    output
        What was printed before the connection was made.
    """

    def __init__(
        self,
        connection: Connection | None,
        limits: Limits,
        size: int,
        failure: PolicyError | None = None,
        output: str = "",
    ) -> None:
        self._connection = connection
        self._limits = limits
        self._size = size
        self._before = output
        self.failure = failure
        """Why the policy could not be made, or failed."""

    @property
    def output(self) -> str:
        """The last 10,000 characters of what the policy has printed in this episode."""
        printed = self._connection.output.text if self._connection else ""
        return self._before + printed if not printed else printed

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
        content = self._asked(["act", observation.tolist()], "action", self._limits.step_seconds)
        numbers, names, values = content if len(content) == 3 else (*content[:1], [], [])
        if type(numbers) is not list or any(type(number) is not float for number in numbers):
            self._fail("sent an action that is not a list of numbers")
        try:
            action = np.array(checked_action("robot", numbers, self._size))
        except ActionError as error:
            self._fail(str(error))
        self._keep(names, values)
        return action

    def _keep(self, names: Any, values: Any) -> None:
        """Take in the internals behind an action; this agent has none."""

    def _asked(self, request: list[Any], kind: str, seconds: float) -> list[Any]:
        """Return the content of the answer to a request."""
        if self.failure is not None or self._connection is None:
            raise self.failure or EvaluatorFault("there is no policy")
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
