"""The processes of a policy, as the process that watches finds them in ``/proc``."""

import contextlib
import os
import signal
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Final, NamedTuple

_STATE, _PARENT, _USER, _SYSTEM, _THREADS, _RESIDENT = 0, 1, 11, 12, 17, 21
_PASSES: Final = 3
"""Passes over the threads when they are moved: a thread may start another meanwhile."""


class Figures(NamedTuple):
    """The figures of a process in ``/proc/PID/stat``."""

    parent: int
    threads: int
    ticks: int
    """Its processor time, in the system's ticks."""
    pages: int
    """Its resident memory, in pages."""


@dataclass(frozen=True)
class Processes:
    """The descendants of this process, by their numbers in its namespace."""

    proc: int
    """Handle of a /proc that shows them. It may be that of an outer namespace, where a container
    allows no other: then their numbers there are found by :meth:`all`."""
    _outer: dict[int, int] = field(default_factory=dict)

    @property
    def _here(self) -> int:
        return int(os.readlink("self", dir_fd=self.proc))

    def all(self) -> dict[int, Figures]:
        """Return the figures of all descendants that have not ended."""
        table, here = dict(self._table()), self._here
        family, size = {here}, 0
        if here == os.getpid() == 1:
            family = set(table)
        while len(family) > size:
            size = len(family)
            family |= {each for each, figures in table.items() if figures.parent in family}
        found = {each: table[each] for each in family - {here} if each in table}
        if here == os.getpid():
            return found
        self._outer.clear()
        for each in found:
            with contextlib.suppress(OSError):
                words = _read(self.proc, f"{each}/status").partition(b"NSpid:")[2]
                self._outer[int(words.partition(b"\n")[0].split()[-1])] = each
        return {inner: found[outer] for inner, outer in self._outer.items()}

    def _table(self) -> Iterator[tuple[int, Figures]]:
        for name in os.listdir(self.proc):  # noqa: PTH208 - a handle
            if name.isdigit():
                with contextlib.suppress(OSError):
                    words = _read(self.proc, f"{name}/stat").rpartition(b")")[2].split()
                    if words[_STATE] != b"Z":
                        ticks = int(words[_USER]) + int(words[_SYSTEM])
                        yield (
                            int(name),
                            Figures(
                                parent=int(words[_PARENT]),
                                threads=int(words[_THREADS]),
                                ticks=ticks,
                                pages=int(words[_RESIDENT]),
                            ),
                        )

    @contextlib.contextmanager
    def opened(self, process: int, name: str, flags: int = os.O_RDONLY) -> Iterator[int]:
        """Yield the handle of one of a process's files or folders in /proc."""
        path = f"{self._outer.get(process, process)}/{name}"
        handle = os.open(path, flags, dir_fd=self.proc)
        try:
            yield handle
        finally:
            os.close(handle)

    def read(self, process: int, name: str) -> bytes:
        """Return the content of one of a process's files in /proc."""
        with self.opened(process, name) as handle:
            return b"".join(iter(lambda: os.read(handle, 1 << 16), b""))

    def files(self, process: int) -> dict[int, str]:
        """Return the open files of a process: their descriptors, and what these refer to."""
        with self.opened(process, "fd") as folder:
            names = os.listdir(folder)  # noqa: PTH208 - a handle
            return {int(name): os.readlink(name, dir_fd=folder) for name in names}

    def move(self, processor: int) -> None:
        """Let them run on this processor alone."""
        for _ in range(_PASSES):
            for process in self.all():
                if process in self._outer:
                    return  # The numbers of the threads are of an outer namespace.
                with contextlib.suppress(OSError), self.opened(process, "task") as tasks:
                    for thread in map(int, os.listdir(tasks)):  # noqa: PTH208
                        os.sched_setaffinity(thread, (processor,))

    def end(self, kept: int | None = None, seconds: float = 5.0) -> bool:
        """End all, but one to be kept, and return whether they are gone within the time."""
        end = time.monotonic() + seconds
        while others := self.all().keys() - {kept}:
            for process in others:
                with contextlib.suppress(OSError):
                    os.kill(process, signal.SIGKILL)
            if time.monotonic() > end:
                return False
            time.sleep(0.0005)
        return True


def _read(folder: int, path: str) -> bytes:
    file = os.open(path, os.O_RDONLY, dir_fd=folder)
    try:
        return os.read(file, 1 << 13)
    finally:
        os.close(file)
