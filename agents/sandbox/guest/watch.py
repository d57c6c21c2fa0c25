"""The watch over a policy's processes: their total use, the reason for their end, their end."""

import contextlib
import itertools
import os
import select
import signal
import time
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from ..protocol import Limits

PERIOD: Final = 0.02
"""Time between two checks of memory, processes and processor time [s]."""

_PAGE: Final = os.sysconf("SC_PAGE_SIZE")
_TICKS: Final = os.sysconf("SC_CLK_TCK")
_PARENT, _USER, _SYSTEM, _THREADS, _RESIDENT = 1, 11, 12, 17, 21
_PASSES: Final = 3
"""Passes over the threads when they are moved: a thread may start another meanwhile."""


@dataclass(frozen=True)
class Watch:
    """The watch over the processes of a policy."""

    child: int
    """The policy's first process."""
    status: int
    """A stream socket. The reason for the end is written to it: ``exit CODE``, ``signal NUMBER``,
    ``memory BYTES``, ``processes NUMBER`` or ``processor SECONDS``. Each number read from it is the
    only processor that the policy may use from then on."""
    processes: int
    """Handle of a /proc with the processes."""
    limits: Limits
    """Their budgets."""
    fresh: tuple[str, ...]
    """Mounted file systems in memory that count as the policy's memory."""

    def run(self) -> None:
        """Watch until the first process ends, a limit is passed or the host ends; then end all."""
        report = ""
        waiting = select.poll()
        waiting.register(self.status, select.POLLIN)
        with contextlib.suppress(OSError):
            waiting.register(os.pidfd_open(self.child), select.POLLIN)
        while not report:
            events = waiting.poll(1000 * PERIOD)
            if any(handle == self.status for handle, _ in events):
                word = os.read(self.status, 100)
                if not word:
                    break
                self._move(int(word.split()[-1]))
            report = self._ended() or self._excess()
        # The status is sent first: the other side waits for it, and ending thousands of processes
        # may take a while.
        if report:
            with contextlib.suppress(OSError):
                os.write(self.status, f"{report}\n".encode())
        self._end_all()

    def _ended(self) -> str:
        """Return how the policy's first process ended, empty if it runs; reap all ended ones."""
        how = ""
        with contextlib.suppress(ChildProcessError):
            while True:
                process, code = os.waitpid(-1, os.WNOHANG)
                if not process:
                    break
                if process == self.child:
                    number = os.waitstatus_to_exitcode(code)
                    how = f"signal {-number}" if number < 0 else f"exit {number}"
        return how

    def _excess(self) -> str:
        found, limits = self._others(), self.limits
        threads = sum(each[_THREADS] for each in found.values())
        if threads > limits.processes:
            return f"processes {threads}"
        spent = sum(each[_USER] + each[_SYSTEM] for each in found.values()) / _TICKS
        if spent > limits.cpu_seconds:
            return f"processor {spent:.0f}"
        files = sum(map(_used, self.fresh))
        # Resident sizes count a shared page once for each process: only an upper bound.
        if sum(each[_RESIDENT] for each in found.values()) * _PAGE + files > limits.memory:
            used = sum(self._proportional(*each) for each in found.items()) + files
            if used > limits.memory:
                return f"memory {used}"
        return ""

    def _proportional(self, process: int, figures: list[int]) -> int:
        """Return the memory of a process, each page divided by the number of its sharers [bytes].

        Files in memory are counted as such.
        """
        try:
            words = self._read(f"{process}/smaps_rollup").split()
        except PermissionError:
            return figures[_RESIDENT] * _PAGE  # A hidden process is not assumed to share.
        except OSError:
            return 0
        sizes = dict(itertools.pairwise(words))
        size = int(sizes.get(b"Pss:", 0)) - int(sizes.get(b"Pss_Shmem:", 0))
        return 1024 * size

    def _others(self) -> dict[int, list[int]]:
        """Return the figures of all descendants, as in /proc/PID/stat from the state on."""
        table = dict(self._table())
        here = int(os.readlink("self", dir_fd=self.processes))
        if self._first and here == 1:
            table.pop(here, None)
            return table
        # This /proc may be of an outer namespace.
        family = {here}
        size = 0
        while len(family) > size:
            size = len(family)
            family |= {each for each, figures in table.items() if figures[_PARENT] in family}
        return {each: table[each] for each in family - {here} if each in table}

    def _table(self) -> Iterator[tuple[int, list[int]]]:
        for name in os.listdir(self.processes):  # noqa: PTH208 - a handle
            if name.isdigit():
                with contextlib.suppress(OSError):
                    words = self._read(f"{name}/stat").rpartition(b")")[2].split()
                    yield int(name), [0, *map(int, words[1:22])]

    def _read(self, path: str) -> bytes:
        handle = os.open(path, os.O_RDONLY, dir_fd=self.processes)
        try:
            return os.read(handle, 1 << 13)
        finally:
            os.close(handle)

    def _move(self, processor: int) -> None:
        """Let the policy run on this processor alone."""
        if self._first and os.readlink("self", dir_fd=self.processes) != "1":
            return  # The numbers in this /proc are of an outer namespace.
        for _ in range(_PASSES):
            for process in self._others():
                with contextlib.suppress(OSError):
                    tasks = os.open(f"{process}/task", os.O_RDONLY, dir_fd=self.processes)
                    try:
                        for thread in map(int, os.listdir(tasks)):  # noqa: PTH208
                            os.sched_setaffinity(thread, (processor,))
                    finally:
                        os.close(tasks)

    @property
    def _first(self) -> bool:
        """Whether this is the first process of a process namespace of its own."""
        return os.getpid() == 1

    def _end_all(self, seconds: float = 5.0) -> None:
        """End all descendants and wait for them."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if self._first:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(-1, signal.SIGKILL)
            else:
                for process in self._others():
                    with contextlib.suppress(ProcessLookupError, PermissionError):
                        os.kill(process, signal.SIGKILL)
            try:
                while os.waitpid(-1, os.WNOHANG)[0]:
                    pass
            except ChildProcessError:
                return
            time.sleep(0.001)


def _used(place: str) -> int:
    """Return the used space of a file system [bytes]."""
    figures = os.statvfs(place)
    return (figures.f_blocks - figures.f_bfree) * figures.f_frsize
