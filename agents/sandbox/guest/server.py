"""The server of a policy, in its restricted process: one answer per request.

Requests are ``[serial, "make"]``, ``[serial, "reset", seed]`` and ``[serial, "act", numbers]``, or
``[serial, "describe"]``. The answer is ``[serial, "made", explains]``, ``[serial, "ready"]``,
``[serial, "action", numbers]`` (with names and values of the internals, if the policy has any),
``[serial, "described", line, parameters]`` or ``[serial, "failed", reason]``.
"""

import contextlib
import faulthandler
import os
import signal
import socket
import sys
from pathlib import Path
from typing import Any, Final

import numpy as np

from ...actions import ActionError, checked_action
from ...agent import Agent, Explaining
from ...errors import InputError, error_text
from ...loading.description import described
from ...loading.loading import PolicySpec
from ...loading.parameters import make_with, read_values
from ...registry import summary
from ...traced import own_traceback
from ..protocol import (
    INTERNALS,
    NAME,
    OURS,
    REASON,
    Assignment,
    Channel,
    ClosedError,
    WireError,
    packed,
)

_OURS: Final = f"{Path(__file__).parent}/"
"""Colift's own files, whose lines in a traceback would not help the policy's author."""

_ORDER: Final = 1000


def serve(handle: int, policy: Assignment, loaded: type[Agent] | None = None) -> None:
    """Serve an episode on a connection until the other side closes it.

    The connection is a file descriptor; ``loaded`` is the policy's class if it is loaded already.
    """
    faulthandler.enable()
    channel = Channel(socket.socket(socket.AF_UNIX, socket.SOCK_STREAM, 0, handle))
    server = _Server(policy, loaded)
    while True:
        try:
            serial, kind, *values = channel.receive()
        except ClosedError:
            return
        answer = server.answer(kind, values)
        try:
            frame = packed([serial, *answer])
        except WireError as error:
            frame = packed([serial, "failed", f"an answer that {error}"[:REASON]])
        channel.send(frame)


def serve_forks(handle: int, policy: Assignment) -> None:
    """Import the policy's module, then fork a process for each order on a socket.

    This process belongs to the policy: anything that the module starts or shares on import survives
    an episode. Therefore an audit plays episodes again, in another order and in fresh sandboxes.
    The answer to the first message is ``[1, "loaded"]``, or the reason for a failure. Each order
    carries the policy's ends of a connection and of the output.
    """
    orders = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET, 0, handle)
    orders.recv(_ORDER)
    try:
        loaded = _load(policy.place)
    except BaseException as error:  # A module can raise anything.
        reason = str(error) if isinstance(error, InputError) else _safe_text(error)
        orders.send(packed([1, "failed", reason[:REASON]]))
        return
    orders.send(packed([1, "loaded"]))
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    while True:
        order, ends, _, _ = socket.recv_fds(orders, _ORDER, 2)
        if not order:
            return
        data, output = ends
        if os.fork() == 0:
            orders.detach()  # The connection takes its place; what the module has opened stays.
            for end, number in ((output, 1), (output, 2), (data, handle)):
                os.dup2(end, number)
            os.close(data)
            os.close(output)
            serve(handle, policy, loaded)
            os._exit(0)
        os.close(data)
        os.close(output)


class _Server:
    """A policy, and whether it explains itself."""

    def __init__(self, policy: Assignment, loaded: type[Agent] | None) -> None:
        self._policy = policy
        self._loaded = loaded
        self._agent: Agent
        self._explains = False

    def answer(self, kind: str, values: list[Any]) -> list[Any]:
        """Return the answer to a request; anything that the policy raises is its failure."""
        try:
            if kind == "act":
                return self._act(values[0])
            if kind == "reset":
                self._agent.reset(values[0])
                return ["ready"]
            if kind == "describe":
                return self._describe()
            return self._make()
        except (ActionError, InputError) as error:
            return ["failed", str(error)[:REASON]]
        except BaseException as error:  # Including SystemExit and KeyboardInterrupt.
            with contextlib.suppress(BaseException):
                print(own_traceback(error, _OURS), end="", file=sys.stderr)
            return ["failed", _safe_text(error)]

    def _make(self) -> list[Any]:
        policy, parameters = self._loaded or _load(self._policy.place), self._policy.parameters
        values = read_values(policy, parameters) if parameters else {}
        self._agent = make_with(policy, values) if values else policy()
        self._explains = isinstance(self._agent, Explaining)
        return ["made", self._explains]

    def _describe(self) -> list[Any]:
        policy = type(self._agent)
        texts = [[each.name, each.default, each.kind, each.meaning] for each in described(policy)]
        return ["described", summary(policy), texts]

    def _act(self, observation: list[float]) -> list[Any]:
        action = checked_action("robot", self._agent.act(np.array(observation)), self._policy.size)
        if not self._explains:
            return ["action", action]
        internals = self._agent.internals()  # type: ignore[attr-defined]
        if len(internals) > INTERNALS or any(len(name) > NAME for name in internals):
            raise ValueError(
                f"more than {INTERNALS} internals, or a name longer than {NAME} letters"
            )
        names = [str(name) for name in internals]
        return ["action", action, names, [float(value) for value in internals.values()]]


def _load(place: str) -> type[Agent]:
    """Return the policy's class; modules beside its file can be imported, if it is not colift's."""
    if not place.startswith(OURS):
        sys.path.insert(0, str(Path.cwd()))
    return PolicySpec(text=place).load()


def _safe_text(error: BaseException) -> str:
    """Return an error on one line; its ``__str__`` is the policy's code, which may fail too."""
    try:
        return error_text(error)[:REASON]
    except BaseException:
        return type(error).__name__[:REASON]
