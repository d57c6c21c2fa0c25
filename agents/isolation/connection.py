"""The scoring side of a cell: requests with deadlines, its output, and why it ended."""

import contextlib
import re
import select
import signal
import socket
import struct
import time
from typing import Any, Final

from ..errors import EvaluatorFault, PolicyError
from .limits import MIB, Limits
from .output import Output
from .wire import Channel, ClosedError, WireError, packed

_REPORT_SECONDS: Final = 1.0
"""How long a cell that has closed the connection may take to say why [s]."""

_SLICE: Final = struct.pack("ll", 0, 5000)
"""How long to wait for an answer before the output is looked at [s, us]: a policy that prints more
than a pipe holds waits that long. To wait for both at once would make every step longer."""

_END_SECONDS: Final = 5.0
"""How long a cell may take to end its processes [s]."""


class Connection:
    """A cell as seen by who scores: nothing that comes from it is trusted."""

    def __init__(
        self,
        *,
        data: socket.socket,
        output: Output,
        status: socket.socket,
        limits: Limits,
        sure: bool,
        shared: bool = False,
    ) -> None:
        """Take the own ends over.

        Parameters
        ----------
        data, output, status
            The own ends.
        limits
            What the policy may use up.
        sure
            Whether the policy cannot end the process that watches it.
        shared
            Whether the cell goes on after this episode, unless it fails.
        """
        self.data = data
        for option in (socket.SO_RCVTIMEO, socket.SO_SNDTIMEO):
            data.setsockopt(socket.SOL_SOCKET, option, _SLICE)
        self._channel = Channel(data)
        self.output = output
        self._status = status
        self._limits = limits
        self._sure = sure
        self._shared = shared
        self._failed = False
        self._serial = 0
        self._left = limits.episode_seconds

    def request(self, content: list[Any], seconds: float) -> list[Any]:
        """Return the answer to a request, without its serial number.

        Raises
        ------
        PolicyError
            If it is late, malformed, out of turn or not there.
        EvaluatorFault
            If the sandbox has failed.
        """
        self._serial += 1
        begin = time.monotonic()
        try:
            self._channel.send(packed([self._serial, *content]))
            answer = self._answer(begin + min(seconds, self._left))
        except ClosedError as error:
            raise self._failure(str(error), _REPORT_SECONDS) from None
        except WireError as error:
            raise self._failure(str(error), 0.0) from None
        self._left -= time.monotonic() - begin
        if answer is None:
            raise self._failure(self._late(seconds), 0.0)
        if len(answer) < 2 or type(answer[0]) is not int or type(answer[1]) is not str:
            raise self._failure("an answer that is not serial number, word and content", 0.0)
        if answer[0] != self._serial:
            raise self._failure(f"answer {answer[0]} to request {self._serial}", 0.0)
        return answer[1:]

    def _answer(self, end: float) -> list[Any] | None:
        """Return the next answer, None if it does not come before the time ``end``."""
        while time.monotonic() < end:
            answer = self._channel.fetch()
            if answer is not None:
                return answer
            self.output.drain()
        return None

    def _late(self, seconds: float) -> str:
        if self._left <= 0:
            return f"took more than {self._limits.episode_seconds:g} s in all"
        what = self._channel.partial or "no answer"
        return f"{what} within {seconds:g} s"

    def _failure(self, reason: str, seconds: float) -> PolicyError | EvaluatorFault:
        """Return the error for a reason, or for the better one that the cell reports."""
        self._failed = True
        self._status.settimeout(seconds)
        try:
            report = self._status.recv(1000).decode(errors="replace").strip()
        except OSError:
            return PolicyError(reason)
        if not report:
            lost = "the sandbox was ended from outside"
            return EvaluatorFault(lost) if self._sure else PolicyError(f"{reason}; {lost}")
        if report.startswith("fault "):
            return EvaluatorFault(f"the sandbox cannot start: {report.removeprefix('fault ')}")
        return PolicyError(self._told(report))

    def _told(self, report: str) -> str:
        limits = self._limits
        match = re.fullmatch(r"(exit|signal|memory|processes) (\d+)", report)
        kind, number = (match[1], int(match[2])) if match else ("", 0)
        if kind == "memory":
            return f"used more than {limits.memory / MIB:.0f} MiB of memory"
        if kind == "processes":
            return f"had more than {limits.processes} processes and threads"
        if kind == "exit":
            return f"ended its process (exit code {number})"
        if number == signal.SIGXCPU:
            return f"used more than {limits.cpu_seconds} s of processor time"
        with contextlib.suppress(ValueError):
            return f"its process was ended by {signal.Signals(number).name}"
        return f"its process was ended by signal {number}"

    @property
    def ended(self) -> bool:
        """Whether the cell has ended."""
        return bool(select.select([self._status], [], [], 0)[0])

    def lost(self) -> PolicyError | EvaluatorFault:
        """Return the error for a cell that has ended."""
        return self._failure("its process has ended", _REPORT_SECONDS)

    def beside(self, data: socket.socket, output: Output) -> "Connection":
        """Return a connection to another process of the same cell."""
        return Connection(
            data=data,
            output=output,
            status=self._status.dup(),
            limits=self._limits,
            sure=self._sure,
            shared=True,
        )

    def close(self) -> None:
        """End the cell: all of its processes are gone afterwards. A shared one, if it failed."""
        self._channel.close()
        if self._shared and not self._failed:
            self._status.close()
            self.output.close()
            return
        self._status.settimeout(_END_SECONDS)
        with contextlib.suppress(OSError):
            self._status.shutdown(socket.SHUT_WR)
            while self._status.recv(1000):
                pass
        self._status.close()
        self.output.close()
