"""Orders to the process that watches a policy, and its reports: the guest that is trusted."""

import contextlib
import signal
import socket
import time
from typing import Final

from colift.agents.sandbox.protocol import MIB, OF_LIFT, Limits
from colift.base.errors import EvaluatorFault, PolicyError

_REFUSALS: Final = {
    "processes": "started a process: a policy has only its own",
    "threads": "has a thread that still runs after its reset: a policy's lifts have one thread",
    "files": "has put other files in the place of its connection or its output",
    "shared": "has shared memory: map files privately, as np.load(..., mmap_mode='c') does",
    "mapping": "has mapped a file that is not in its folder or among the installed packages",
}
"""What the gate refuses, by the first word of the report."""


class Status:
    """One end of the stream of orders and reports."""

    def __init__(self, end: socket.socket) -> None:
        self._end = end
        self._received = b""
        self._ended = False

    def order(self, line: str) -> None:
        """Send an order, without waiting until it is followed."""
        with contextlib.suppress(OSError):
            self._end.send(f"{line}\n".encode(), socket.MSG_DONTWAIT | socket.MSG_NOSIGNAL)

    def report(self, seconds: float) -> str | None:
        """Return the next report; empty if none comes in time, None if there will be no more."""
        end = time.monotonic() + seconds
        while b"\n" not in self._received and not self._ended:
            left = end - time.monotonic()
            self._end.settimeout(max(left, 0.0))
            try:
                words = self._end.recv(1000)
            except (TimeoutError, BlockingIOError):
                return ""
            except OSError:
                words = b""
            self._received += words
            self._ended = not words
        line, newline, self._received = self._received.partition(b"\n")
        return line.decode(errors="replace") if newline or line else None

    def hang_up(self) -> None:
        """Tell that there will be no more orders: the processes end."""
        with contextlib.suppress(OSError):
            self._end.shutdown(socket.SHUT_WR)

    def close(self) -> None:
        """Close this end."""
        self._end.close()


def told(report: str, limits: Limits) -> PolicyError | EvaluatorFault:
    """Return the error for a report of an end."""
    if report.startswith("fault "):
        return EvaluatorFault(f"the sandbox cannot start: {report.removeprefix('fault ')}")
    return PolicyError(_in_words(report.removeprefix(OF_LIFT), limits))


def _in_words(report: str, limits: Limits) -> str:
    kind, _, rest = report.partition(" ")
    number = int(rest) if rest.isdecimal() else 0
    if kind == "refused":
        what, _, _ = rest.partition(" ")
        return f"{_REFUSALS.get(what, 'could not be closed in')} ({rest})"
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
