"""A sandbox: a fork server at an isolation level, and the cells of the policies it starts."""

import json
import os
import socket
from collections import Counter
from pathlib import Path
from typing import Final, NamedTuple

from colift.agents.sandbox.host.cell import Cell
from colift.agents.sandbox.host.connection import Connection
from colift.agents.sandbox.host.output import Output
from colift.agents.sandbox.host.process import ForkServer
from colift.agents.sandbox.host.status import Status
from colift.agents.sandbox.protocol import Assignment, Limits
from colift.base.errors import EvaluatorFault, PolicyError

_FAILURES: Final = 3
"""Cells of a policy that may fail before no further one is started. A policy that is loaded again
learns the time, and with it how long the lifts before took: it must not be so at its will."""

_IDLE: Final = 4
"""Cells that are kept for a next lift."""


class Load(NamedTuple):
    """What has to be the same for a cell to be used again."""

    policy: Assignment
    instance: str
    """Instances of a policy are loaded apart; see :class:`.SandboxedPolicy`."""


class Sandbox:
    """A fork server, started again whenever it has ended; for use by one thread.

    The parameters are those of :class:`.ForkServer`. The constructor and :meth:`take` raise
    EvaluatorFault if it does not start.
    """

    def __init__(self, isolation: str, seen: Path | None, limits: Limits) -> None:
        self._start = isolation, seen, limits
        self._limits = limits
        self._server = ForkServer(*self._start)
        self._idle: list[tuple[Load, Cell]] = []
        self._failed: Counter[Load] = Counter()

    def take(self, load: Load, *seeds: int | None) -> Cell:
        """Return a cell with a policy: reset with one of the seeds, or not yet reset for None.

        Without seeds any cell will do.
        """
        for kept in reversed(self._idle):
            if kept[0] == load and (not seeds or kept[1].seed in seeds):
                self._idle.remove(kept)
                return kept[1]
        return Cell(self._started(load.policy))

    def give(self, load: Load, cell: Cell) -> None:
        """Take a cell back, for a next lift; the policy of one that has failed is loaded again."""
        if cell.failure is not None:
            cell.close()
            if isinstance(cell.failure, PolicyError):
                self._failed[load] += 1
            if self._failed[load] < _FAILURES:
                return
        self._idle.append((load, cell))
        while len(self._idle) > _IDLE:
            self._idle.pop(0)[1].close()

    def _started(self, policy: Assignment) -> Connection:
        """Return the connection to a new process; start the fork server again if it has ended."""
        if not self._server.alive:
            self.close()
            self._server = ForkServer(*self._start)
        data, its_data = socket.socketpair()
        status, its_status = socket.socketpair()
        reading, writing = os.pipe()
        connection = Connection(
            data=data,
            output=Output(reading),
            status=Status(status),
            limits=self._limits,
            sure=bool(self._server.namespaces),
        )
        theirs = [its_data.fileno(), writing, its_status.fileno()]
        try:
            socket.send_fds(self._server.orders, [json.dumps(policy).encode()], theirs)
        except OSError as error:
            connection.close()
            status.close()
            raise EvaluatorFault(f"the sandbox has ended: {error}") from error
        finally:
            its_data.close()
            its_status.close()
            os.close(writing)
        return connection

    def drop(self) -> None:
        """End the cells that are kept for a next lift."""
        while self._idle:
            self._idle.pop()[1].close()

    def close(self) -> None:
        """End all of its processes."""
        self.drop()
        self._server.close()
