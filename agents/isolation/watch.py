"""The first process of a cell: it starts the policy's, watches what they use, ends them all."""

import contextlib
import os
import select
import signal
import time
from pathlib import Path
from typing import Final

PERIOD: Final = 0.02
"""Time between two looks at memory and processes [s]."""

_PAGE: Final = os.sysconf("SC_PAGE_SIZE")
_PARENT, _THREADS, _RESIDENT = 1, 17, 21


def watch(child: int, status: int, *, memory: int, processes: int, period: float = PERIOD) -> None:
    """Watch the policy's processes until the first ends, the limits are passed, or it is told.

    What happened is written to ``status``: ``exit CODE``, ``signal NUMBER``, ``memory BYTES`` or
    ``processes NUMBER``. Then, or when the other side of ``status`` closes, all are ended.

    Parameters
    ----------
    child
        The policy's first process.
    status
        A stream socket.
    memory
        Most memory together [bytes].
    processes
        Most processes and threads.
    """
    report = ""
    waiting = select.poll()
    waiting.register(status, select.POLLIN)
    with contextlib.suppress(OSError):
        waiting.register(os.pidfd_open(child), select.POLLIN)
    while True:
        events = waiting.poll(1000 * period)
        if any(handle == status for handle, _ in events):
            break
        report = _ended(child) or _excess(memory, processes)
        if report:
            break
    # The status first: the other side waits for it, and ending thousands may take a while.
    if report:
        with contextlib.suppress(OSError):
            os.write(status, f"{report}\n".encode())
    end_all()


def _ended(child: int) -> str:
    """Return how the policy's first process ended, empty if it has not; reap all that have."""
    how = ""
    with contextlib.suppress(ChildProcessError):
        while True:
            process, code = os.waitpid(-1, os.WNOHANG)
            if not process:
                break
            if process == child:
                number = os.waitstatus_to_exitcode(code)
                how = f"signal {-number}" if number < 0 else f"exit {number}"
    return how


def _excess(memory: int, processes: int) -> str:
    found = others()
    threads = sum(each[_THREADS] for each in found.values())
    if threads > processes:
        return f"processes {threads}"
    # Resident sizes count a shared page once for each process: only an upper bound.
    if sum(each[_RESIDENT] for each in found.values()) * _PAGE > memory:
        used = sum(_proportional(process, found[process]) for process in found)
        if used > memory:
            return f"memory {used}"
    return ""


def _proportional(process: int, figures: list[int]) -> int:
    """Return the memory of a process, each page divided by how many share it [bytes]."""
    try:
        lines = Path(f"/proc/{process}/smaps_rollup").read_text().splitlines()
        return next(1024 * int(line.split()[1]) for line in lines if line.startswith("Pss:"))
    except PermissionError:
        return figures[_RESIDENT] * _PAGE  # Who hides from us is not believed to share anything.
    except (OSError, StopIteration):
        return 0


def others() -> dict[int, list[int]]:
    """Return the figures of all descendants by process, as in /proc/PID/stat from the state on."""
    table = {}
    for name in os.listdir("/proc"):  # noqa: PTH208 - fifty times a second
        if name.isdigit() and (figures := _figures(name)):
            table[int(name)] = figures
    # A /proc may be of an outer namespace, so this process asks it who it is.
    here = int(os.readlink("/proc/self"))  # noqa: PTH115
    if _first() and here == 1:
        table.pop(here, None)
        return table
    family = {here}
    size = 0
    while len(family) > size:
        size = len(family)
        family |= {each for each, figures in table.items() if figures[_PARENT] in family}
    return {each: table[each] for each in family - {here} if each in table}


def _figures(process: str) -> list[int]:
    try:
        with open(f"/proc/{process}/stat", "rb") as file:  # noqa: PTH123 - as above
            words = file.read().rpartition(b")")[2].split()
    except OSError:
        return []
    return [0, *map(int, words[1:22])]


def _first() -> bool:
    """Return whether this is the first process of a process namespace of its own."""
    return os.getpid() == 1


def end_all(seconds: float = 5.0) -> None:
    """End all descendants and wait for them."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if _first():
            with contextlib.suppress(ProcessLookupError):
                os.kill(-1, signal.SIGKILL)
        else:
            for process in others():
                with contextlib.suppress(ProcessLookupError, PermissionError):
                    os.kill(process, signal.SIGKILL)
        try:
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass
        except ChildProcessError:
            return
        time.sleep(0.001)
