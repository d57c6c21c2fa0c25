"""A connection to a policy's process: requests with deadlines, output, reason for its end."""

import contextlib
import socket
import struct
import time
from dataclasses import dataclass
from typing import Any, Final

from colift.agents.sandbox.host.output import Output
from colift.agents.sandbox.host.status import Status, told
from colift.agents.sandbox.protocol import Channel, ClosedError, Limits, WireError, packed
from colift.base.errors import EvaluatorFault, PolicyError

_REPORT_SECONDS: Final = 1.0
"""Time limit for the report of a process that has closed the connection [s]."""

_SLICE: Final = struct.pack("ll", 0, 5000)
"""Time for an answer before the output is read [s, us]: a policy that fills the pipe waits that
long. Waiting for answer and output at once would make every step longer."""


@dataclass(eq=False, kw_only=True)
class Connection:
    """The host's ends of a process's channels: nothing that they deliver is trusted."""

    data: socket.socket
    output: Output
    status: Status
    limits: Limits
    """The policy's budgets."""
    sure: bool
    """Whether it is certain that the policy cannot end the process that watches it."""
    failure: PolicyError | EvaluatorFault | None = None
    """The failure that ends all requests."""
    report: str = ""
    """The report of its end, if there is one."""
    _serial: int = 0
    _paced: bool = False

    def __post_init__(self) -> None:
        """Set the time limits of the socket."""
        for option in (socket.SO_RCVTIMEO, socket.SO_SNDTIMEO):
            self.data.setsockopt(socket.SOL_SOCKET, option, _SLICE)
        self._channel = Channel(self.data)
        self._left = self.limits.start_seconds

    def request(self, content: list[Any], seconds: float, more: float = 0.0) -> list[Any]:
        """Return the answer to a request, without its serial number.

        The answer may take ``seconds`` [s]; ``more`` is the time that the request adds to the
        budget of all answers [s]. Raise PolicyError if the answer is late, malformed, out of turn
        or missing, and EvaluatorFault if the sandbox has failed.
        """
        if self.failure is not None:
            raise self.failure
        self._serial += 1
        self._left += more
        self._paced = more > 0.0
        begin, short = time.monotonic(), self._left < seconds
        try:
            self._channel.send(packed([self._serial, *content]))
            answer = self._answer(begin + min(seconds, self._left))
        except ClosedError as error:
            raise self.failed(str(error), _REPORT_SECONDS) from None
        except WireError as error:
            raise self.failed(str(error), 0.0) from None
        self._left -= time.monotonic() - begin
        if answer is None:
            raise self.failed(self._late(seconds, short), 0.0)
        if len(answer) < 2 or type(answer[0]) is not int or type(answer[1]) is not str:
            raise self.failed("an answer that is not serial number, word and content", 0.0)
        if answer[0] != self._serial:
            raise self.failed(f"answer {answer[0]} to request {self._serial}", 0.0)
        return answer[1:]

    def expect(self, report: str, seconds: float) -> None:
        """Wait for a report; raise an error, as :meth:`request`, if there is another or none."""
        found = self.status.report(seconds)
        if found != report:
            raise self.failed("did not start in time", 0.0, found)

    def _answer(self, end: float) -> list[Any] | None:
        """Return the next answer; None if it does not come before the time ``end``."""
        while time.monotonic() < end:
            answer = self._channel.fetch()
            if answer is not None:
                return answer
            self.output.drain()
        return None

    def _late(self, seconds: float, short: bool) -> str:
        limits = self.limits
        if short and not self._paced:
            return f"took more than {limits.start_seconds:g} s to start"
        if short:
            start, pace = limits.start_seconds, limits.pace_seconds
            return f"took more than {start:g} s and {pace:g} s a step in all"
        what = self._channel.partial or "no answer"
        return f"{what} within {seconds:g} s"

    def failed(
        self, reason: str, seconds: float, report: str | None = ""
    ) -> PolicyError | EvaluatorFault:
        """Return and keep the error for a reason; a reported reason takes precedence."""
        report = report or self.status.report(seconds)
        if report:
            self.report = report
            self.failure = told(report, self.limits)
        elif report == "":
            self.failure = PolicyError(reason)
        else:
            lost = "the sandbox was ended from outside"
            self.failure = EvaluatorFault(lost) if self.sure else PolicyError(f"{reason}; {lost}")
        return self.failure

    def close(self) -> None:
        """Close the channels that are this process's alone."""
        self._channel.close()
        with contextlib.suppress(OSError):
            self.output.close()
