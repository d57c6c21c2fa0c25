"""The server of a policy, in its restricted process: it loads the policy, and forks its lifts.

A policy is loaded once: imported, made and reset, before there is a lift. Then a filter closes
behind it, and each lift is a fork of that state, behind a second filter that leaves it only its
connection; see :mod:`.gate`.

Requests are ``[serial, "make"]``, ``[serial, "describe"]`` and ``[serial, "reset", seed]``, and
after the fork ``[serial, "act", numbers]``, or ``[serial, "reset", seed]`` for the next lift of a
session. The answer is ``[serial, "made", explains]``,
``[serial, "described", line, parameters]``, ``[serial, "ready"]``, ``[serial, "action", numbers]``
(with names and values of the internals, if the policy has any) or ``[serial, "failed", reason]``.
A byte with two files, the lift's end of its connection and its output, orders a lift.
"""

import contextlib
import faulthandler
import gc
import linecache
import os
import socket
import sys
from pathlib import Path
from typing import Any, Final

# NumPy imports these of its parts when they are first used; in a lift it could not.
import numpy as np
import numpy.fft
import numpy.linalg
import numpy.ma
import numpy.polynomial
import numpy.random
from colift.agents.actions import ActionError, checked_action
from colift.agents.agent import Agent, Explaining, Remembering
from colift.agents.loading.description import described
from colift.agents.loading.late import import_late
from colift.agents.loading.parameters import make_with, read_values
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.sandbox.guest.filters import CHANNEL, FORKING, LIFT, install
from colift.agents.sandbox.protocol import (
    INTERNALS,
    NAME,
    OURS,
    REASON,
    SHOWN,
    Assignment,
    Channel,
    ClosedError,
    WireError,
    packed,
)
from colift.agents.traced import own_traceback
from colift.base.errors import InputError, error_text
from colift.base.registry import summary

_OURS: Final = f"{Path(__file__).parent}/"
"""Colift's own files, whose lines in a traceback would not help the policy's author."""

CURE: Final = (
    "in a lift a policy has no files, imports, threads or processes: "
    "what it needs of them belongs into its module, its constructor or its reset"
)
"""What a policy's author should know if the filter has refused something."""


def serve(filtered: bool, policy: Assignment) -> None:
    """Serve a policy on the connection until the other side closes it."""
    faulthandler.enable()
    server = _Server(policy)
    with contextlib.suppress(ClosedError):
        if server.load():
            if filtered:
                install(FORKING)
            server.tell_ready()
            _fork_lifts(server, filtered)


def _fork_lifts(server: "_Server", filtered: bool) -> None:
    """Fork a lift for each order, by a process that ends at once.

    The parent of the lift is then the process that watches.
    """
    orders = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM, 0, CHANNEL)
    while True:
        order, ends, _, _ = socket.recv_fds(orders, 1, 2)
        if not order:
            return
        between = os.fork()
        if between == 0:
            if os.fork() == 0:
                for end, number in zip((ends[1], ends[1], ends[0]), (1, 2, CHANNEL), strict=True):
                    os.dup2(end, number)
                for end in ends:
                    os.close(end)
                if filtered:
                    install(LIFT)
                with contextlib.suppress(ClosedError):
                    server.act()
            os._exit(0)
        for end in ends:
            os.close(end)
        with contextlib.suppress(ChildProcessError):
            os.waitpid(between, 0)


class _Server:
    """A policy, and the answers to requests."""

    def __init__(self, policy: Assignment) -> None:
        self._policy = policy
        self._agent: Agent
        self._explains = False
        self._inside = False
        self._folder = Path.cwd()
        self._ready: bytes = b""
        self._channel = Channel(socket.socket(socket.AF_UNIX, socket.SOCK_STREAM, 0, CHANNEL))

    def load(self) -> bool:
        """Answer requests until the policy is loaded; return whether that succeeded."""
        while True:
            serial, kind, *values = self._channel.receive()
            answer = self._answer(kind, values)
            if answer == ["ready"]:
                self._ready = packed([serial, *answer])
                import_late()
                _remember_sources()
                gc.freeze()
                os.closerange(CHANNEL + 1, os.sysconf("SC_OPEN_MAX"))
                return True
            self._send(serial, answer)

    def tell_ready(self) -> None:
        """Answer the request by which the policy was loaded."""
        self._channel.send(self._ready)

    def act(self) -> None:
        """Answer requests of a lift, and of those that follow it in its session."""
        self._inside = True
        while True:
            serial, kind, value = self._channel.receive()
            self._send(serial, self._answer("act" if kind == "act" else "reset", [value]))

    def _send(self, serial: int, answer: list[Any]) -> None:
        try:
            frame = packed([serial, *answer])
        except WireError as error:
            frame = packed([serial, "failed", f"an answer that {error}"[:REASON]])
        self._channel.send(frame)

    def _answer(self, kind: str, values: list[Any]) -> list[Any]:
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
                print(own_traceback(error, _OURS, self._folder), end="", file=sys.stderr)
            reason = _safe_text(error)
            if self._inside and _was_refused(error):
                reason = f"{reason[: REASON - len(CURE) - 2]}; {CURE}"
            return ["failed", reason]

    def _make(self) -> list[Any]:
        policy, parameters = _load(self._policy.origin), self._policy.parameters
        values = read_values(policy, parameters) if parameters else {}
        self._agent = make_with(policy, values) if values else policy()
        if isinstance(self._agent, Remembering):
            self._agent.begin_session()
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


def _load(origin: str) -> type[Agent]:
    """Return the policy's class; modules beside its file can be imported, if it is not colift's."""
    if not origin.startswith(OURS):
        sys.path.insert(0, str(Path.cwd()))
    return PolicySpec(text=origin).load()


def _remember_sources() -> None:
    """Read the policy's own files, whose lines tracebacks show when none can be read any more."""
    installed = (*filter(None, sys.path[1:]), *map(str, SHOWN))
    for module in tuple(sys.modules.values()):
        file = vars(module).get("__file__")
        if isinstance(file, str) and file.endswith(".py") and not file.startswith(installed):
            lines = linecache.getlines(file)
            linecache.cache[file] = (sum(map(len, lines)), None, lines, file)


def _was_refused(error: BaseException) -> bool:
    """Return whether an error, or what it came from, may be a refusal of the filter."""
    chain: BaseException | None = error
    while chain is not None:
        if isinstance(chain, OSError | ImportError) or "start new thread" in _safe_text(chain):
            return True
        chain = chain.__cause__ or chain.__context__
    return False


def _safe_text(error: BaseException) -> str:
    """Return an error on one line; its ``__str__`` is the policy's code, which may fail too."""
    try:
        return error_text(error)[:REASON]
    except BaseException:
        return type(error).__name__[:REASON]
