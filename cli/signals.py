"""Ctrl-C and SIGTERM: a command cleans up, and says by its exit code that it was ended."""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from colift.cli.loading import Ending

Handler = Callable[[int, FrameType | None], Any] | int
"""A handler of a signal."""


@contextmanager
def interruptible() -> Iterator[Ending]:
    """Let SIGTERM interrupt the body as Ctrl-C does, so that nothing half-written is left."""
    ending = Ending()
    with _handled(signal.SIGTERM, signal.SIG_DFL, ending.terminate):
        yield ending


@contextmanager
def _handled(number: int, usual: Handler, handler: Handler) -> Iterator[None]:
    """Handle a signal while the body runs, if its handler is the usual one.

    A process in the background ignores Ctrl-C, and shall go on to; only the main thread can set
    handlers.
    """
    if (
        threading.current_thread() is not threading.main_thread()
        or signal.getsignal(number) != usual
    ):
        yield
        return
    signal.signal(number, handler)
    try:
        yield
    finally:
        if signal.getsignal(number) == handler:
            signal.signal(number, usual)
