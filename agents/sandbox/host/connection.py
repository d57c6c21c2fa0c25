"""A connection to a policy's process: requests with deadlines, output, reason for its end."""

import contextlib
import os
import re
import select
import signal
import socket
import struct
import time
from dataclasses import dataclass, replace
from typing import Any, Final
from unicodedata import category

from ...errors import EvaluatorFault, PolicyError
from ..protocol import MIB, OUTPUT, Channel, ClosedError, Limits, WireError, packed

_REPORT_SECONDS: Final = 1.0
"""Time limit for the report of a process that has closed the connection [s]."""

_SLICE: Final = struct.pack("ll", 0, 5000)
"""Time for an answer before the output is read [s, us]: a policy that fills the pipe waits that
long. Waiting for answer and output at once would make every step longer."""

_END_SECONDS: Final = 5.0
"""Time limit for the processes of an episode to end [s]."""

_CHUNK: Final = 64 * 1024
_CHUNKS: Final = 16
"""Most chunks per read: a policy that prints without end must not block the reader."""

_SEQUENCE: Final = re.compile(r"\x1b\[[0-?]*[ -/]*[@-~]")

_UNSEEN: Final = frozenset({"Cc", "Cf", "Cn", "Co", "Cs", "Zl", "Zp"})
"""Unicode categories of invisible characters, which can reverse, hide or split a text."""


def clean(text: str) -> str:
    """Return an untrusted text without invisible characters, except line ends and tabs.

    Invisible characters are control characters, marks and isolates of the direction of text,
    separators of lines and paragraphs, and private and unassigned characters.
    """
    shown = _SEQUENCE.sub("", text.encode(errors="replace").decode())
    if shown.isascii() and shown.isprintable():
        return shown
    return "".join(each for each in shown if each in "\n\t" or category(each) not in _UNSEEN)


class Output:
    """The reading end of a pipe; only the end of the output is kept."""

    def __init__(self, handle: int) -> None:
        os.set_blocking(handle, False)
        self._handle: int | None = handle
        self._tail = b""

    def drain(self) -> None:
        """Read the output so far, without waiting."""
        if self._handle is None:
            return
        with contextlib.suppress(BlockingIOError):
            for _ in range(_CHUNKS):
                chunk = os.read(self._handle, _CHUNK)
                if not chunk:
                    return
                # A character takes at most four bytes.
                self._tail = (self._tail + chunk)[-4 * OUTPUT :]

    def close(self) -> None:
        """Read the output so far, and close."""
        self.drain()
        if self._handle is not None:
            os.close(self._handle)
            self._handle = None

    @property
    def text(self) -> str:
        """The last characters of the output."""
        self.drain()
        return clean(self._tail.decode(errors="replace"))[-OUTPUT:]


@dataclass(eq=False, kw_only=True)
class Connection:
    """The host's ends of an episode's channels: nothing that they deliver is trusted."""

    data: socket.socket
    output: Output
    status: socket.socket
    limits: Limits
    """The policy's budgets."""
    sure: bool
    """Whether it is certain that the policy cannot end the process that watches it."""
    shared: bool = False
    """Whether the processes outlive this episode, unless it fails."""
    failure: PolicyError | EvaluatorFault | None = None
    """The failure that ends all requests."""
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
            raise self._failure(str(error), _REPORT_SECONDS) from None
        except WireError as error:
            raise self._failure(str(error), 0.0) from None
        self._left -= time.monotonic() - begin
        if answer is None:
            raise self._failure(self._late(seconds, short), 0.0)
        if len(answer) < 2 or type(answer[0]) is not int or type(answer[1]) is not str:
            raise self._failure("an answer that is not serial number, word and content", 0.0)
        if answer[0] != self._serial:
            raise self._failure(f"answer {answer[0]} to request {self._serial}", 0.0)
        return answer[1:]

    def move(self, processor: int) -> None:
        """Pin the policy to a processor, without waiting until it is."""
        with contextlib.suppress(OSError):
            self.status.send(f"{processor}\n".encode(), socket.MSG_DONTWAIT | socket.MSG_NOSIGNAL)

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

    def _failure(self, reason: str, seconds: float) -> PolicyError | EvaluatorFault:
        """Return and keep the error for a reason; a reported reason takes precedence."""
        self.failure = self._reported(reason, seconds)
        return self.failure

    def _reported(self, reason: str, seconds: float) -> PolicyError | EvaluatorFault:
        self.status.settimeout(seconds)
        try:
            report = self.status.recv(1000).decode(errors="replace").strip()
        except OSError:
            return PolicyError(reason)
        if not report:
            lost = "the sandbox was ended from outside"
            return EvaluatorFault(lost) if self.sure else PolicyError(f"{reason}; {lost}")
        if report.startswith("fault "):
            return EvaluatorFault(f"the sandbox cannot start: {report.removeprefix('fault ')}")
        return PolicyError(self._in_words(report))

    def _in_words(self, report: str) -> str:
        limits = self.limits
        match = re.fullmatch(r"(exit|signal|memory|processes|processor) (\d+)", report)
        kind, number = (match[1], int(match[2])) if match else ("", 0)
        if kind == "memory":
            return f"used more than {limits.memory / MIB:.0f} MiB of memory"
        if kind == "processes":
            return f"had more than {limits.processes} processes and threads"
        if kind == "exit":
            return f"ended its process (exit code {number})"
        if kind == "processor" or number == signal.SIGXCPU:
            return f"used more than {limits.cpu_seconds} s of processor time"
        with contextlib.suppress(ValueError):
            return f"its process was ended by {signal.Signals(number).name}"
        return f"its process was ended by signal {number}"

    @property
    def ended(self) -> bool:
        """Whether the processes have ended."""
        return bool(select.select([self.status], [], [], 0)[0])

    def lost(self) -> PolicyError | EvaluatorFault:
        """Return the error for processes that have ended."""
        return self._failure("its process has ended", _REPORT_SECONDS)

    def beside(self, data: socket.socket, output: Output) -> "Connection":
        """Return a connection to another process beside this one."""
        return replace(self, data=data, output=output, status=self.status.dup(), shared=True)

    def close(self) -> None:
        """End all processes of the episode; shared ones only if it failed."""
        self._channel.close()
        if not self.shared or self.failure is not None:
            with contextlib.suppress(OSError):
                self.status.settimeout(_END_SECONDS)
                self.status.shutdown(socket.SHUT_WR)
                while self.status.recv(1000):
                    pass
        self.status.close()
        self.output.close()
