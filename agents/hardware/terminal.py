"""A terminal that may vanish: a closed window, a lost connection, a reader that has ended."""

import os
import select
import stat
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Final

from colift.agents.hardware.operator import StopButton

GONE: Final = "the terminal is gone"
"""Reason of a stop after the terminal has vanished."""

INTERVAL: Final = 0.1
"""Time between two looks at the terminal [s]."""


@contextmanager
def watched(button: StopButton) -> Iterator[None]:
    """Press the button when the terminal vanishes, or nobody can read the messages any more.

    What vanishes is replaced by the null device, so that a later message, or the flush at the end
    of the process, does not fail.
    """
    over = threading.Event()
    watcher = threading.Thread(target=_watch, args=(button, over), name="terminal", daemon=True)
    watcher.start()
    try:
        yield
    finally:
        over.set()
        watcher.join()


def _watch(button: StopButton, over: threading.Event) -> None:
    poll = select.poll()
    for number in _descriptors():
        poll.register(number, 0)  # Only what is always reported: hang-up and error.
    while not over.is_set():
        for number, event in poll.poll(0):
            poll.unregister(number)
            if not event & select.POLLNVAL:
                button.press(GONE)
                _silence(number)
        over.wait(INTERVAL)


def _descriptors() -> Iterator[int]:
    """Yield the descriptors of the terminal, and of a pipe or socket for messages."""
    for stream in (sys.stdin, sys.stdout, sys.stderr):
        # Not all streams have a descriptor, and a closed one is None.
        with suppress(OSError, ValueError, AttributeError):
            number = stream.fileno()
            mode = os.fstat(number).st_mode
            messages = stream is sys.stderr and (stat.S_ISFIFO(mode) or stat.S_ISSOCK(mode))
            if os.isatty(number) or messages:
                yield number


def _silence(number: int) -> None:
    null = os.open(os.devnull, os.O_RDWR)
    os.dup2(null, number)
    os.close(null)


def tell(line: str) -> None:
    """Print a line to the operator, on stderr; without one, do nothing."""
    if sys.stderr is not None:
        with suppress(OSError, ValueError):
            print(line, file=sys.stderr, flush=True)
