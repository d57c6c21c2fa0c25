"""A sandboxed policy as an agent."""

import ctypes
import functools
import math
import os
from typing import Any, Final, NoReturn

import numpy as np

from ...agent import Action, Observation
from ...errors import PolicyError
from ...loading.description import ParameterText
from ..protocol import INTERNALS, NAME, REASON, Limits
from .connection import Connection, clean

TURNS: Final = 8
"""Turns on one processor before the scheduler may choose another."""

_libc = functools.cache(lambda: ctypes.CDLL(None))


@functools.cache
def allowed() -> frozenset[int]:
    """Return the processors that this process may run on, read before a thread is pinned."""
    return frozenset(os.sched_getaffinity(0))


class Caller:
    """The calling thread of a policy; both take turns on one processor.

    On two processors every turn would have to wake an idle one, which takes longer than the turn
    itself: a step would cost twice as much. Every few turns the scheduler may move the thread, and
    the policy follows; otherwise two pairs could share one processor while another is idle. The
    policy itself cannot leave its processor.
    """

    def __init__(self) -> None:
        self._allowed = allowed()
        self._here = -1
        self._turns = 0

    def begin(self) -> int:
        """Begin a turn, and return the number of its processor."""
        if self._turns == 0:
            self._here = _libc().sched_getcpu()
            os.sched_setaffinity(0, (self._here,))
        self._turns += 1
        return self._here

    def end(self) -> None:
        """End a turn."""
        if self._turns >= TURNS:
            self.free()

    def free(self) -> None:
        """Let this thread run anywhere again."""
        if self._turns > 0:
            os.sched_setaffinity(0, self._allowed)
            self._turns = 0


class RemoteAgent:
    """An agent whose policy runs in a sandbox.

    Its methods raise PolicyError if the policy could not be made, fails or gives an invalid answer,
    and EvaluatorFault if the sandbox fails. Its actions have ``size`` numbers.
    """

    def __init__(self, connection: Connection, limits: Limits, size: int) -> None:
        self._connection = connection
        self._limits = limits
        self._size = size
        self._caller = Caller()
        self._processor = -1
        self.failure: PolicyError | None = None
        """The failure of the policy, or of its construction."""

    def close(self) -> None:
        """Let this thread run on any processor again."""
        self._caller.free()

    @property
    def printed(self) -> str:
        """Return the last 10,000 characters of the policy's output in this episode."""
        return self._connection.output.text

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._asked(["reset", seed], "ready", self._limits.start_seconds)

    def act(self, observation: Observation) -> Action:
        """Return the policy's action."""
        here = self._caller.begin()
        if here != self._processor:
            self._processor = here
            self._connection.move(here)
        limits, request = self._limits, ["act", observation.tolist()]
        content = self._asked(request, "action", limits.step_seconds, limits.pace_seconds)
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

    def described(self) -> tuple[str, tuple[ParameterText, ...]]:
        """Return the first line of the policy's docstring, and its parameters."""
        content = self._asked(["describe"], "described", self._limits.start_seconds)
        line, texts = (*content, None, None)[:2]
        if not (
            type(line) is str
            and type(texts) is list
            and all(type(text) is list and len(text) == 4 for text in texts)
            and all(type(word) is str for text in texts for word in text)
        ):
            self._fail("its parameters are not names and texts")
        words = [[clean(word) for word in text] for text in texts]
        return clean(line), tuple(
            ParameterText(name=name, default=default, kind=kind, meaning=meaning)
            for name, default, kind, meaning in words
        )

    def _keep(self, names: Any, values: Any) -> None:
        """Keep the internals of an action; this agent has none."""

    def _asked(self, request: list[Any], kind: str, seconds: float, more: float = 0.0) -> list[Any]:
        """Return the content of the answer to a request."""
        if self.failure is not None:
            raise self.failure
        try:
            answer, *content = self._connection.request(request, seconds, more)
        except PolicyError as error:
            self.failure = error
            raise
        if answer == "failed" and len(content) == 1 and type(content[0]) is str:
            self._fail(content[0])
        if answer != kind:
            self._fail(f"answered {answer!r:.40} where {kind!r} was due")
        return content

    def _fail(self, reason: str) -> NoReturn:
        self.failure = PolicyError(clean(reason)[:REASON])
        raise self.failure from None


class ExplainingRemoteAgent(RemoteAgent):
    """A remote agent whose policy has internals."""

    _internals: dict[str, float] | None = None

    def internals(self) -> dict[str, float]:
        """Return the internals of the last action."""
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
    """Return the agent for a connection; if its policy cannot be made, ``reset`` raises the reason.

    Raise EvaluatorFault if the sandbox fails.
    """
    agent = RemoteAgent(connection, limits, size)
    try:
        explains = agent._asked(["make"], "made", limits.start_seconds)
    except PolicyError:
        return agent
    if explains == [True]:
        return ExplainingRemoteAgent(connection, limits, size)
    return agent
