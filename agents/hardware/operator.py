"""The operator's controls: confirmation of manual steps, and a stop at any time."""

import select
import signal
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from queue import Empty, SimpleQueue
from typing import Final

from colift.agents.hardware.stops import Stop, StopTrialError
from colift.base.errors import InputError

STOPPING: Final = tuple(
    getattr(signal, name)
    for name in (
        "SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT", "SIGTSTP", "SIGUSR1", "SIGUSR2", "SIGALRM",
        "SIGXCPU", "SIGPWR",
    )
    if hasattr(signal, name)
)  # fmt: skip
"""Signals that press the button: each would end or suspend the process, with the arms stiff."""

BACKGROUND: Final = (signal.SIGTTIN, signal.SIGTTOU)
"""Signals that suspend a process in the background for using its terminal; they are ignored."""

ENTER: Final = "the Enter key"
"""Reason of a stop by the Enter key."""

AT_THE_TERMINAL: Final = ("SIGINT", "SIGTSTP", ENTER)
"""Reasons of a stop by somebody who is at the terminal."""

HANDOVER: Final = 5.0
"""Time to take the table out of the hands where nobody confirms it [s]."""


class StopButton:
    """A latching stop button; pressing it wakes all waiting threads."""

    def __init__(self) -> None:
        # A handler of signals presses it amid a wait of its own thread. A queue of this kind may be
        # filled there; a threading.Event may not: its lock is taken, and both wait forever.
        self._bell: SimpleQueue[None] = SimpleQueue()
        self._reason: str | None = None
        self._presses: list[str] = []

    @property
    def reason(self) -> str | None:
        """Means by which it was pressed, or None."""
        return self._reason

    @property
    def presses(self) -> Sequence[str]:
        """Means of all presses, in their order."""
        return self._presses

    @property
    def at_terminal(self) -> bool:
        """Whether it is not pressed, or was pressed at the terminal."""
        return self._reason is None or self._reason in AT_THE_TERMINAL

    def press(self, reason: str) -> None:
        """Press it; only the first reason counts."""
        self._presses.append(reason)
        if self._reason is None:
            self._reason = reason
        self._bell.put(None)

    def wait(self, seconds: float) -> bool:
        """Wait at most ``seconds``; return whether it is pressed."""
        if self._reason is None:
            with suppress(Empty):
                self._bell.put(self._bell.get(timeout=seconds))
        return self._reason is not None


@contextmanager
def armed(button: StopButton, numbers: Sequence[int] = STOPPING) -> Iterator[None]:
    """Let signals press the button instead of their usual effect; main thread only.

    That includes signals which were ignored, such as Ctrl-C in the background of a shell, or a
    hang-up under ``nohup``.
    """

    def press(number: int, _: object) -> None:
        button.press(signal.Signals(number).name)

    before = {number: signal.signal(number, press) for number in numbers}
    before |= {number: signal.signal(number, signal.SIG_IGN) for number in BACKGROUND}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, signal.SIG_DFL if handler is None else handler)


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
    """Press the button at a line from the terminal, or at the end of its input."""
    while not over.is_set():
        if not _line_waits():
            continue
        try:
            line = sys.stdin.readline()
        except OSError:
            # The line is for another process: this one is in the background.
            over.wait(0.1)
            continue
        button.press(ENTER if line else "the terminal's input has ended")
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
        _refuse_if_pressed(button)
    if not _line():
        # A terminal that vanishes also sends a signal.
        button.wait(0.2)
        _refuse_if_pressed(button)
        raise InputError("there is no terminal on which to press Enter")


def _refuse_if_pressed(button: StopButton) -> None:
    if button.reason is not None:
        raise StopTrialError(Stop.OPERATOR, f"stopped by the operator: {button.reason}")


def await_table_out(button: StopButton, *, attended: bool) -> None:
    """Wait until the operator has taken the table out of the hands: for Enter or Ctrl-C.

    Without an operator, wait for :data:`HANDOVER`; also after a stop that did not come from the
    terminal, and from the moment when the terminal vanishes.

    Parameters
    ----------
    button
        The stop button: it may be pressed already, and again.
    attended
        Whether there is an operator who confirms.
    """
    listening, known = attended, len(button.presses)
    forever = attended and button.at_terminal
    end = time.monotonic() + (float("inf") if forever else HANDOVER)
    while time.monotonic() < end:
        if not listening:
            time.sleep(0.05)
        elif _line_waits():
            if _line():
                return
            listening = False
            end = min(end, time.monotonic() + HANDOVER)
        new = button.presses[known:]
        known += len(new)
        if attended and "SIGINT" in new:
            return
        if new:
            end = min(end, time.monotonic() + HANDOVER)


def _line_waits() -> bool:
    """Return whether there is a line to read or the input is over, after at most 0.1 s."""
    try:
        return bool(select.select([sys.stdin], [], [], 0.1)[0])
    except (OSError, ValueError, TypeError):
        return True


def _line() -> str:
    """Return a line of the input; an empty text if there is no input any more."""
    try:
        return sys.stdin.readline()
    except (OSError, ValueError, AttributeError):
        return ""
