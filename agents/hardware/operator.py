"""The operator's controls: confirmation of manual steps, and a stop at any time."""

import select
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from ..errors import InputError
from .stops import Stop, StopTrialError


class StopButton:
    """A latching stop button; pressing it wakes all waiting threads."""

    def __init__(self) -> None:
        self._event = threading.Event()
        self._reason: str | None = None

    @property
    def reason(self) -> str | None:
        """Means by which it was pressed, or None."""
        return self._reason

    def press(self, reason: str) -> None:
        """Press it; only the first reason counts."""
        if self._reason is None:
            self._reason = reason
        self._event.set()

    def wait(self, seconds: float) -> bool:
        """Wait at most ``seconds``; return whether it is pressed."""
        return self._event.wait(seconds)


@contextmanager
def armed(button: StopButton) -> Iterator[None]:
    """Let Ctrl-C and SIGTERM press the button instead of their usual effect; main thread only."""
    before = {
        number: signal.signal(number, lambda number, _: button.press(signal.Signals(number).name))
        for number in (signal.SIGINT, signal.SIGTERM)
    }
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@contextmanager
def key_stops(button: StopButton) -> Iterator[None]:
    """Let the Enter key press the button, on a terminal."""
    over = threading.Event()
    listener = threading.Thread(target=_listen, args=(button, over), daemon=True)
    if sys.stdin is not None and sys.stdin.isatty():
        listener.start()
    try:
        yield
    finally:
        over.set()
        if listener.is_alive():
            listener.join()


def _listen(button: StopButton, over: threading.Event) -> None:
    """Press the button at a line from the terminal."""
    while not over.is_set():
        if _line_waits():
            sys.stdin.readline()
            button.press("the Enter key")
            return


def await_enter(button: StopButton) -> None:
    """Wait for the Enter key.

    Raises
    ------
    StopTrialError
        If the button is pressed instead.
    InputError
        If the input has ended, so that no key can be pressed.
    """
    while not _line_waits():
        if button.reason is not None:
            raise StopTrialError(Stop.OPERATOR, f"stopped by the operator: {button.reason}")
    if not sys.stdin.readline():
        raise InputError("there is no terminal on which to press Enter")


def _line_waits() -> bool:
    """Return whether there is a line to read, after at most a tenth of a second."""
    return bool(select.select([sys.stdin], [], [], 0.1)[0])
