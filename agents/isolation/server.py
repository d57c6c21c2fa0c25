"""What runs in a cell: makes the policy, and answers for it, one answer to a request.

Requests are ``[serial, "make"]``, ``[serial, "reset", seed]`` and ``[serial, "act", processor,
numbers]``. The answer is ``[serial, "made", explains]``, ``[serial, "ready"]``, ``[serial,
"action", numbers]`` (with names and values of the internals behind it if it explains) or
``[serial, "failed", reason]``.
"""

import contextlib
import faulthandler
import socket
import sys
import traceback
from pathlib import Path
from typing import Any, Final

import numpy as np

from ..actions import ActionError, checked_action
from ..agent import Agent, Explaining
from ..errors import InputError, told
from ..policies.loading import PolicySpec
from ..policies.parameters import make_with, read_values
from .limits import REASON
from .processor import Answerer
from .wire import Channel, ClosedError, WireError, packed

INTERNALS: Final = 64
"""Most internals of a policy."""

NAME: Final = 64
"""Characters of an internal's name."""


def serve(
    handle: int, place: str, parameters: str, size: int, policy: type[Agent] | None = None
) -> None:
    """Serve an episode on a connection until the other side closes it.

    Parameters
    ----------
    handle
        File descriptor of the connection.
    place, parameters
        Where the policy's class is, and what is set of it.
    size
        How many numbers its action must be.
    policy
        The class, if it is loaded already.
    """
    faulthandler.enable()
    channel = Channel(socket.socket(fileno=handle))
    server = _Server(place, parameters, size, policy)
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


class _Server:
    """A policy, and whether it explains itself."""

    def __init__(self, place: str, parameters: str, size: int, policy: type[Agent] | None) -> None:
        self._place = place
        self._parameters = parameters
        self._size = size
        self._policy = policy
        self._agent: Agent
        self._explains = False
        self._answerer = Answerer()

    def answer(self, kind: str, values: list[Any]) -> list[Any]:
        """Return the answer to a request; whatever the policy raises is a failure."""
        try:
            if kind == "act":
                processor, observation = values
                self._answerer.follow(processor)
                return self._act(observation)
            if kind == "reset":
                self._agent.reset(values[0])
                return ["ready"]
            return self._make()
        except (ActionError, InputError) as error:
            return ["failed", str(error)[:REASON]]
        except BaseException as error:  # SystemExit and KeyboardInterrupt too are the policy's.
            with contextlib.suppress(BaseException):
                traceback.print_exc()
            return ["failed", safely_told(error)]

    def _make(self) -> list[Any]:
        policy = self._policy or load(self._place)
        values = read_values(policy, self._parameters) if self._parameters else {}
        self._agent = make_with(policy, values) if values else policy()
        self._explains = isinstance(self._agent, Explaining)
        return ["made", self._explains]

    def _act(self, observation: list[float]) -> list[Any]:
        action = checked_action("robot", self._agent.act(np.array(observation)), self._size)
        if not self._explains:
            return ["action", action]
        internals = self._agent.internals()  # type: ignore[attr-defined]
        if len(internals) > INTERNALS or any(len(name) > NAME for name in internals):
            raise ValueError(f"more than {INTERNALS} internals, or a name of over {NAME} letters")
        names = [str(name) for name in internals]
        return ["action", action, names, [float(value) for value in internals.values()]]


def load(place: str) -> type[Agent]:
    """Return the policy's class; modules beside its file can be imported."""
    sys.path.insert(0, str(Path.cwd()))
    return PolicySpec(text=place).load()


def safely_told(error: BaseException) -> str:
    """Return an error in a line; its text is the policy's code, which may fail too."""
    try:
        return told(error)[:REASON]
    except BaseException:
        return type(error).__name__[:REASON]
