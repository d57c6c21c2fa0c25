"""The watch over a policy's processes: their total use, the reason for their end, their end."""

import contextlib
import itertools
import os
import select
import signal
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from colift.agents.sandbox.guest.gate import Gate
from colift.agents.sandbox.guest.processes import Figures, Processes
from colift.agents.sandbox.protocol import CLOSED, END, ENDED, FORK, OF_LIFT, Limits

PERIOD: Final = 0.02
"""Time between two checks of memory, processes and processor time [s]."""

_PAGE: Final = os.sysconf("SC_PAGE_SIZE")
_TICKS: Final = os.sysconf("SC_CLK_TCK")


@dataclass(kw_only=True)
class Watch:
    """The watch over the processes of a policy: that in which it is loaded, and that of a lift."""

    loaded: int
    """The process in which it is loaded."""
    status: int
    """A stream socket with a line for each report and each order; see :mod:`..protocol`."""
    processes: Processes
    limits: Limits
    """The budgets of all processes together."""
    fresh: tuple[str, ...]
    """Mounted file systems in memory that count as the policy's memory."""
    gate: Gate | None
    """None where system calls cannot be filtered."""
    _orders: bytes = b""
    _lifting: bool = False
    _excessive: bool = False

    def run(self) -> None:
        """Watch until the policy's first process ends, passes a limit, or the host ends; end all.

        A lift that passes a limit is ended alone.
        """
        waiting = select.poll()
        waiting.register(self.status, select.POLLIN)
        if self.gate is None:
            self._report(CLOSED)
        else:
            waiting.register(self.gate.listener, select.POLLIN)
        # The end of a process wakes the watch.
        awake, waking = os.pipe2(os.O_NONBLOCK | os.O_CLOEXEC)
        signal.signal(signal.SIGCHLD, lambda *_: None)
        signal.set_wakeup_fd(waking, warn_on_full_buffer=False)
        waiting.register(awake, select.POLLIN)
        going = True
        while going:
            ready = _ready(waiting, 1000 * PERIOD)
            if awake in ready:
                os.read(awake, 1000)
            asked = self.gate is not None and self.gate.listener in ready
            # An order came before what is asked because of it.
            if self.status in (_ready(waiting, 0) if asked else ready):
                going = self._obey()
            if self.gate is not None and asked:
                self._report(self.gate.answer())
            going = self._reap() and self._bounded() and going
        self.processes.end()
        self._reap()

    def _report(self, line: str) -> None:
        if line:
            with contextlib.suppress(OSError):
                os.write(self.status, f"{line}\n".encode(errors="replace"))

    def _obey(self) -> bool:
        """Follow the orders that have come; return whether there will be more."""
        words = b""
        with contextlib.suppress(OSError):
            words = os.read(self.status, 1000)
        *orders, self._orders = (self._orders + words).split(b"\n")
        for order in map(bytes.decode, orders):
            if order == FORK:
                self._lifting = True
                if self.gate is None:
                    self._report(CLOSED)
                else:
                    self.gate.order()
            elif order == END:
                if not self._end_lift():
                    return False
                self._report(ENDED)
            else:
                self.processes.move(int(order))
        return bool(words)

    def _end_lift(self) -> bool:
        """End the lift, and return whether nothing of it is left."""
        gone = self.processes.end(kept=self.loaded)
        self._lifting = False
        self._reap()
        if self.gate is not None:
            self.gate.forget()
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.loaded, signal.SIGCONT)
        return gone

    def _reap(self) -> bool:
        """Report ended processes; return whether the loaded one is still there."""
        going = True
        for process, code in _ended():
            number = os.waitstatus_to_exitcode(code)
            how = f"signal {-number}" if number < 0 else f"exit {number}"
            if process == self.loaded:
                self._report(how)
                going = False
            elif self._lifting and (self.gate is None or process == self.gate.lift):
                self._report(f"{OF_LIFT}{how}")
        return going

    def _bounded(self) -> bool:
        """Report an excess, and end the lift; return False if there is none to be ended."""
        excess = self._excess()
        if not excess:
            return True
        if not self._lifting:
            self._report(excess)
            return False
        self._report(f"{OF_LIFT}{excess}")
        return self._end_lift()

    def _excess(self) -> str:
        found, limits = self.processes.all(), self.limits
        threads = sum(each.threads for each in found.values())
        if threads > limits.processes:
            return f"processes {threads}"
        spent = sum(each.ticks for each in found.values()) / _TICKS
        if spent > limits.cpu_seconds:
            return f"processor {spent:.0f}"
        files = sum(map(_used, self.fresh))
        # Resident sizes count a shared page once for each process: only an upper bound.
        if sum(each.pages for each in found.values()) * _PAGE + files > limits.memory:
            used = sum(self._proportional(*each) for each in found.items()) + files
            if used > limits.memory:
                return f"memory {used}"
        return ""

    def _proportional(self, process: int, figures: Figures) -> int:
        """Return the memory of a process, each page divided by the number of its sharers [bytes].

        Files in memory are counted as such.
        """
        try:
            words = self.processes.read(process, "smaps_rollup").split()
        except PermissionError:
            return figures.pages * _PAGE  # A hidden process is not assumed to share.
        except OSError:
            return 0
        sizes = dict(itertools.pairwise(words))
        return 1024 * (int(sizes.get(b"Pss:", 0)) - int(sizes.get(b"Pss_Shmem:", 0)))


def _ready(waiting: "select.poll", milliseconds: float) -> set[int]:
    """Return the handles that can be read within a time."""
    return {handle for handle, _ in waiting.poll(milliseconds)}


def _ended() -> Iterator[tuple[int, int]]:
    """Yield the children that have ended: number and status."""
    with contextlib.suppress(ChildProcessError):
        while True:
            process, code = os.waitpid(-1, os.WNOHANG)
            if not process:
                return
            yield process, code


def _used(place: str) -> int:
    """Return the used space of a file system [bytes]."""
    figures = os.statvfs(place)
    return (figures.f_blocks - figures.f_bfree) * figures.f_frsize
