"""A sandboxed policy as an agent."""

import ctypes
import functools
import math
import os
from typing import Any, Final, NoReturn

import numpy as np
from colift.agents.agent import Action, Observation
from colift.agents.loading.description import ParameterText
from colift.agents.sandbox.host.cell import Cell
from colift.agents.sandbox.host.connection import Connection
from colift.agents.sandbox.host.output import clean
from colift.agents.sandbox.host.sandbox import Load, Sandbox
from colift.agents.sandbox.protocol import INTERNALS, NAME, OUTPUT, REASON, Limits
from colift.base.errors import EvaluatorFault, PolicyError

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
    """An agent whose policy runs in a sandbox, each session in a process of its own.

    Its methods raise PolicyError if the policy could not be made, fails or gives an invalid answer,
    and EvaluatorFault if the sandbox fails. Its actions have ``size`` numbers.
    """

    def __init__(self, sandbox: Sandbox, load: Load, limits: Limits, cell: Cell) -> None:
        self._sandbox = sandbox
        self._load = load
        self._limits = limits
        self._size = load.policy.size
        self._cell = cell
        self._lift: Connection | None = None
        self._caller = Caller()
        self._processor = -1
        self.failure: PolicyError | None = None
        """The failure of the policy, or of its construction."""

    def close(self) -> None:
        """End the episode, and let this thread run on any processor again."""
        self._caller.free()
        self._end()
        self._sandbox.give(self._load, self._cell)

    def _end(self) -> None:
        if self._lift is not None:
            self._printed = self._lift.output.text
            self._cell.end(self._lift)
            self._lift = None

    _printed = ""

    @property
    def printed(self) -> str:
        """Return the last 10,000 characters of the policy's output: loading, then this episode."""
        lift = self._printed if self._lift is None else self._lift.output.text
        return f"{self._cell.printed}{lift}"[-OUTPUT:]

    def reset(self, seed: int) -> None:
        """Begin a session, with its first lift."""
        self._end()
        self.failure = None
        if self._cell.seed not in (None, seed):
            self._change_cell(None, seed)
        if self._cell.seed is None and self._cell.failure is None:
            self._cell.reset(seed)
        self._lift = self._cell.lift()
        self._processor = -1
        if self._lift.failure is not None:
            self._raise(self._lift.failure)

    def resume(self, seed: int) -> None:
        """Begin the next lift of the session, in the same process."""
        if self._lift is None:
            raise PolicyError("resume before reset")
        self._asked(self._lift, ["reset", seed], "ready")

    def _change_cell(self, *seeds: int | None) -> None:
        self._sandbox.give(self._load, self._cell)
        self._cell = self._sandbox.take(self._load, *seeds)

    def _raise(self, error: PolicyError | EvaluatorFault) -> NoReturn:
        if isinstance(error, PolicyError):
            self.failure = error
        raise error

    def act(self, observation: Observation) -> Action:
        """Return the policy's action."""
        if self._lift is None:
            raise PolicyError("act before reset")
        here = self._caller.begin()
        if here != self._processor:
            self._processor = here
            self._lift.status.order(str(here))
        content = self._asked(self._lift, ["act", observation.tolist()], "action")
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
        if self._cell.seed is not None:
            self._change_cell(None)
        line, texts = (*self._cell.describe(), None, None)[:2]
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

    def _asked(self, lift: Connection, request: list[Any], due: str) -> list[Any]:
        """Return the content of the answer to a request, which is of the kind that is due."""
        if self.failure is not None:
            raise self.failure
        limits = self._limits
        try:
            answer, *content = lift.request(request, limits.step_seconds, limits.pace_seconds)
        except PolicyError as error:
            self._raise(error)
        if answer == "failed" and len(content) == 1 and type(content[0]) is str:
            self._fail(content[0])
        if answer != due:
            self._fail(f"answered {answer!r:.40} where {due!r} was due")
        return content

    def _fail(self, reason: str) -> NoReturn:
        self._raise(PolicyError(clean(reason)[:REASON]))


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


def remote_agent(sandbox: Sandbox, load: Load, limits: Limits) -> RemoteAgent:
    """Return an agent for a policy; if it cannot be made, ``reset`` raises the reason.

    Raise EvaluatorFault if the sandbox fails.
    """
    cell = sandbox.take(load)
    kind = ExplainingRemoteAgent if cell.explains else RemoteAgent
    agent = kind(sandbox, load, limits, cell)
    if isinstance(cell.failure, EvaluatorFault):
        agent.close()
        raise cell.failure
    agent.failure = cell.failure
    return agent
