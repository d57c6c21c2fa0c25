"""A cell: the processes of a policy that is loaded once, and whose lifts are forked from there."""

import contextlib
import os
import socket
import weakref
from collections.abc import Callable
from typing import Any, Final

from colift.agents.sandbox.host.connection import Connection
from colift.agents.sandbox.host.output import Output, clean
from colift.agents.sandbox.protocol import CLOSED, END, ENDED, FORK, OF_LIFT, REASON
from colift.base.errors import EvaluatorFault, PolicyError

_END_SECONDS: Final = 6.0
"""Time limit for the processes of a lift to end [s]."""


class Cell:
    """A policy in its process; its lifts are forked from it one after the other.

    It is asked to make the policy and to reset it; then it is closed, and only forks. If one of
    these fails, :attr:`failure` has the reason, and every lift fails with it.
    """

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self.close = weakref.finalize(self, _close, os.getpid(), connection)
        """End all of its processes."""
        self.seed: int | None = None
        """The seed of the reset; None before."""
        self.explains = False
        """Whether the policy explains itself."""
        self._ask(["make"], "made", self._note)

    def _note(self, content: list[Any]) -> None:
        self.explains = content == [True]

    @property
    def failure(self) -> PolicyError | EvaluatorFault | None:
        """The reason why it has no lifts; None if it has."""
        return self._connection.failure

    @property
    def printed(self) -> str:
        """The end of the policy's output while it was loaded."""
        return self._connection.output.text

    def describe(self) -> list[Any]:
        """Return the line and the parameters with which the policy describes itself, unchecked."""
        found: list[Any] = []
        self._ask(["describe"], "described", found.extend)
        if self.failure is not None:
            raise self.failure
        return found

    def reset(self, seed: int) -> None:
        """Reset the policy, and close the cell."""
        self.seed = seed
        self._ask(["reset", seed], "ready", lambda content: None)
        if self.failure is None:
            with contextlib.suppress(PolicyError, EvaluatorFault):
                self._connection.expect(CLOSED, self._connection.limits.start_seconds)

    def _ask(self, request: list[Any], kind: str, use: Callable[[list[Any]], None]) -> None:
        """Use the content of an answer, unless the request fails."""
        connection = self._connection
        with contextlib.suppress(PolicyError, EvaluatorFault):
            answer, *content = connection.request(request, connection.limits.start_seconds)
            if answer == kind:
                use(content)
            elif answer == "failed" and len(content) == 1 and type(content[0]) is str:
                connection.failure = PolicyError(clean(content[0])[:REASON])
            else:
                reason = f"answered {answer!r:.40} where {kind!r} was due"
                connection.failure = PolicyError(clean(reason)[:REASON])

    def lift(self) -> Connection:
        """Return the connection to a new lift; it fails if there is none.

        It is ended by :meth:`end`, before there can be another.
        """
        own = self._connection
        data, theirs = socket.socketpair()
        reading, writing = os.pipe()
        lift = Connection(
            data=data,
            output=Output(reading),
            status=own.status,
            limits=own.limits,
            sure=own.sure,
            failure=own.failure,
        )
        try:
            if lift.failure is None:
                own.status.order(FORK)
                socket.send_fds(own.data, [b"l"], [theirs.fileno(), writing])
                lift.expect(CLOSED, own.limits.start_seconds)
        except OSError:
            lift.failed("its process has ended", _END_SECONDS)
        except (PolicyError, EvaluatorFault):
            pass  # The lift has the failure.
        finally:
            theirs.close()
            os.close(writing)
        return lift

    def end(self, lift: Connection) -> None:
        """End a lift: nothing of it is left. If that fails, the cell does."""
        lift.close()
        own = self._connection
        if own.failure is not None:
            return
        if lift.report and not lift.report.startswith(OF_LIFT):
            own.failed("its process has ended", 0.0, lift.report)
            return
        own.status.order(END)
        while (report := own.status.report(_END_SECONDS)) != ENDED:
            if not (report and report.startswith(OF_LIFT)):
                own.failed("its lift does not end", 0.0, report)
                return


def _close(owner: int, connection: Connection) -> None:
    """End all processes of a cell; in a fork of its owner, only close the sockets."""
    status = connection.status
    connection.close()
    if os.getpid() == owner:
        status.hang_up()
        while status.report(_END_SECONDS):
            pass
    status.close()
