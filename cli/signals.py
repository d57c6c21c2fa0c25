"""Ctrl-C and SIGTERM: a command cleans up, and says by its exit code that it was ended."""

import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any, Final

from colift.cli.loading import Ending

Handler = Callable[[int, FrameType | None], Any] | int
"""A handler of a signal."""

ENDING: Final = (signal.SIGINT, signal.SIGTERM)
"""Signals that end a command."""

AGAIN: Final = 0.01
"""Seconds after which a lost interrupt is raised again."""


@contextmanager
def interruptible() -> Iterator[Ending]:
    """Let SIGTERM interrupt the body as Ctrl-C does, so that nothing half-written is left."""
    ending = Ending()
    with _handled(signal.SIGTERM, signal.SIG_DFL, ending.terminate), _none_lost():
        yield ending


@contextmanager
def until_signalled(last_words: str = "") -> Iterator[None]:
    """Run the body until one of the signals of :data:`ENDING` comes: that is no error.

    The first one interrupts the body, and all others are ignored: a second one would cut short the
    cleanup.

    Parameters
    ----------
    last_words
        What is said after a signal, on stderr.
    """
    for number in ENDING:
        signal.signal(number, _interrupt)
    try:
        yield
    except KeyboardInterrupt:
        if last_words:
            print(last_words, file=sys.stderr)


def _interrupt(number: int, frame: FrameType | None) -> None:
    for each in ENDING:
        signal.signal(each, signal.SIG_IGN)
    raise KeyboardInterrupt


@contextmanager
def _none_lost() -> Iterator[None]:
    """Raise an interrupt again if it came while a finalizer or a callback ran.

    Python prints and drops an exception there: the command would go on.
    """
    usual = sys.unraisablehook

    def again(lost: "sys.UnraisableHookArgs") -> None:
        if not isinstance(lost.exc_value, KeyboardInterrupt):
            usual(lost)
            return
        before = signal.getsignal(signal.SIGINT)

        def once(number: int, frame: FrameType | None) -> None:
            signal.signal(number, before)
            raise KeyboardInterrupt

        signal.signal(signal.SIGINT, once)
        main = threading.main_thread().ident or 0
        threading.Timer(AGAIN, signal.pthread_kill, (main, signal.SIGINT)).start()

    sys.unraisablehook = again
    try:
        yield
    finally:
        sys.unraisablehook = usual


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
