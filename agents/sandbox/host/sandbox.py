"""A sandbox: a fork server at an isolation level, and connections to the processes it starts."""

import json
import os
import socket
from pathlib import Path
from typing import Any

from ...errors import EvaluatorFault, PolicyError
from ..protocol import EPISODE, PRELOAD, PROBE, REASON, Assignment, Limits
from .connection import Connection, Output, clean
from .process import ForkServer


class Sandbox:
    """A fork server, started again whenever it has ended; for use by one thread.

    The parameters are those of :class:`.ForkServer`. The constructor and all methods that return a
    connection raise EvaluatorFault if it does not start.
    """

    def __init__(self, isolation: str, seen: Path | None, limits: Limits) -> None:
        self._start = isolation, seen, limits
        self._limits = limits
        self._server = ForkServer(*self._start)
        self._preload: Connection | None = None
        self._preloaded: Assignment | None = None

    def episode(self, policy: Assignment) -> Connection:
        """Return the connection to a new process for a policy."""
        return self._started(EPISODE, policy)

    def probe(self, secrets: dict[str, Any]) -> Connection:
        """Return the connection to a process that tries the forbidden actions."""
        return self._started(PROBE, secrets)

    def preloaded(self, policy: Assignment) -> Connection:
        """Return the connection to a process forked from one that has imported the policy.

        If the policy cannot be imported, the connection has that failure.
        """
        if self._preload is None or self._preload.ended or self._preloaded != policy:
            self._end_preload()
            imported = self._imported(policy)
            if imported.failure is not None:
                return imported
            self._preload, self._preloaded = imported, policy
        data, theirs = socket.socketpair()
        reading, writing = os.pipe()
        connection = self._preload.beside(data, Output(reading))
        try:
            socket.send_fds(self._preload.data, [b"e"], [theirs.fileno(), writing])
        except OSError:
            connection.failure = self._preload.lost()
            self._end_preload()
        finally:
            theirs.close()
            os.close(writing)
        return connection

    def _imported(self, policy: Assignment) -> Connection:
        """Return the connection to a process that has imported a policy, or failed to."""
        connection = self._started(PRELOAD, policy, socket.SOCK_SEQPACKET)
        try:
            kind, *reason = connection.request(["load"], self._limits.start_seconds)
            if kind != "loaded":
                connection.failure = PolicyError(clean(str(*reason[:1]))[:REASON])
        except (PolicyError, EvaluatorFault) as error:
            connection.failure = error
        return connection

    def _end_preload(self) -> None:
        if self._preload is not None:
            self._preload.close()
            self._preload = None

    def _started(self, kind: str, content: object, type_: int = socket.SOCK_STREAM) -> Connection:
        """Return the connection to a new process; start the fork server again if it has ended."""
        if not self._server.alive:
            self.close()
            self._server = ForkServer(*self._start)
        data, its_data = socket.socketpair(socket.AF_UNIX, type_)
        status, its_status = socket.socketpair()
        reading, writing = os.pipe()
        connection = Connection(
            data=data,
            output=Output(reading),
            status=status,
            limits=self._limits,
            sure=bool(self._server.namespaces),
        )
        theirs = [its_data.fileno(), writing, its_status.fileno()]
        try:
            socket.send_fds(self._server.orders, [json.dumps([kind, content]).encode()], theirs)
        except OSError as error:
            connection.close()
            raise EvaluatorFault(f"the sandbox has ended: {error}") from error
        finally:
            its_data.close()
            its_status.close()
            os.close(writing)
        return connection

    def close(self) -> None:
        """End all of its processes."""
        self._end_preload()
        self._server.close()
