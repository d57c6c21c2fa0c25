"""A sandbox: a fork server on a rung of the ladder, and the cells that it starts."""

import json
import os
import socket
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import EvaluatorFault, PolicyError
from .connection import Connection
from .forkserver import EPISODE, PRELOAD, PROBE
from .launch import BUBBLEWRAP
from .limits import REASON, Limits
from .output import Output, clean
from .process import ForkServer


@dataclass(frozen=True, kw_only=True)
class Work:
    """What a cell is for."""

    place: str
    """Where the policy's class is: ``module:Class`` or ``file.py:Class``."""
    parameters: str = ""
    """What is set of it."""
    size: int = 1
    """How many numbers its action is."""

    def order(self, kind: bytes) -> bytes:
        """Return the order for a cell."""
        return kind + json.dumps([self.place, self.parameters, self.size]).encode()


class Sandbox:
    """A fork server that is started again when it has ended; use it from one thread.

    Parameters
    ----------
    rung, seen, limits
        As for :class:`.ForkServer`.

    Raises
    ------
    EvaluatorFault
        If it does not start.
    """

    def __init__(self, rung: str, seen: Path | None, limits: Limits) -> None:
        self.rung = rung
        self._seen = seen
        self._limits = limits
        self._server = ForkServer(rung, seen, limits)
        self._inner: Connection | None = None
        self._work: Work | None = None
        self.imported = ""
        """What the policy's module printed when it was imported for all episodes."""

    @property
    def namespaces(self) -> str:
        """Which namespaces its cells have; see :class:`.walls.Walls`."""
        return self._server.namespaces

    def episode(self, work: Work) -> Connection:
        """Return the connection to a fresh cell for a policy.

        Raises
        ------
        EvaluatorFault
            If there is none to be had.
        """
        # Without namespaces inside, only a new bubblewrap has a fresh /tmp.
        self._revive(anew=self.rung == BUBBLEWRAP and not self.namespaces)
        return self._cell(work.order(EPISODE))

    def probe(self, secrets: dict[str, Any]) -> Connection:
        """Return the connection to a cell that tries what no policy may."""
        return self._cell(PROBE + json.dumps(secrets).encode())

    def preloaded(self, work: Work) -> Connection:
        """Return the connection to a process forked from one that has imported the policy.

        Raises
        ------
        PolicyError
            If the policy cannot be imported.
        EvaluatorFault
            If there is no cell to be had.
        """
        if self._inner is None or self._inner.ended or self._work != work:
            self._inner = self._importing(work)
        data, theirs = socket.socketpair()
        reading, writing = os.pipe()
        connection = self._inner.beside(data, Output(reading))
        try:
            socket.send_fds(self._inner.data, [b"e"], [theirs.fileno(), writing])
        except OSError:
            connection.close()
            lost = self._inner.lost()
            self._end_inner()
            raise lost from None
        finally:
            theirs.close()
            os.close(writing)
        return connection

    def _importing(self, work: Work) -> Connection:
        """Return the connection to a new cell that has imported a policy."""
        self._end_inner()
        self._work = work
        self._revive()
        inner = self._cell(work.order(PRELOAD), socket.SOCK_SEQPACKET)
        try:
            kind, *reason = inner.request(["load"], self._limits.start_seconds)
        except (PolicyError, EvaluatorFault):
            inner.close()
            self.imported = inner.output.text
            raise
        self.imported = inner.output.text
        if kind != "loaded":
            inner.close()
            raise PolicyError(clean(str(*reason[:1]))[:REASON])
        return inner

    def _end_inner(self) -> None:
        if self._inner is not None:
            self._inner.close()
            self._inner = None

    def _revive(self, *, anew: bool = False) -> None:
        """Start the fork server again if it has ended, or is to be another."""
        if anew or not self._server.alive:
            self.close()
            self._server = ForkServer(self.rung, self._seen, self._limits)

    def _cell(self, order: bytes, kind: int = socket.SOCK_STREAM) -> Connection:
        """Return the connection to a new cell."""
        data, its_data = socket.socketpair(socket.AF_UNIX, kind)
        status, its_status = socket.socketpair()
        reading, writing = os.pipe()
        theirs = [its_data.fileno(), writing, its_status.fileno()]
        connection = Connection(
            data=data,
            output=Output(reading),
            status=status,
            limits=self._limits,
            sure=bool(self.namespaces),
        )
        try:
            socket.send_fds(self._server.orders, [order], theirs)
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
        self._end_inner()
        self._server.close()
