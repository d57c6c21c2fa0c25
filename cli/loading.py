"""Ctrl-C and SIGTERM while libraries are imported: the process ends at once, and says nothing.

Nothing has begun then; an interrupt inside an import would end in the library's traceback, or be
lost in one of its callbacks. For the same reason this module imports next to nothing.
"""

import os
import signal

INTERRUPTED = 130
"""Exit code of an interrupted command, as in shells."""

TERMINATED = 128 + signal.SIGTERM
"""Exit code after SIGTERM."""


class Ending:
    """The exit code of a command that a signal ends."""

    code: int = INTERRUPTED

    def terminate(self, number: int, frame: object) -> None:
        """Raise KeyboardInterrupt for SIGTERM; a second one ends the process at once."""
        signal.signal(number, signal.SIG_DFL)
        self.code = TERMINATED
        raise KeyboardInterrupt


class Loading:
    """While its body imports something, Ctrl-C and SIGTERM end the process at once.

    A signal that is ignored, or that somebody else handles, stays so.
    """

    def __enter__(self) -> None:
        """Take over the signals."""
        self._kept = []
        for number, code in ((signal.SIGINT, INTERRUPTED), (signal.SIGTERM, TERMINATED)):
            handler = signal.getsignal(number)
            usual = handler is signal.default_int_handler
            if usual or isinstance(getattr(handler, "__self__", None), Ending):
                try:
                    signal.signal(number, lambda *_, code=code: os._exit(code))
                    self._kept.append((number, handler))
                except ValueError:
                    pass  # Only the main thread can, and only it would be interrupted.

    def __exit__(self, *error: object) -> None:
        """Give the signals back."""
        for number, handler in self._kept:
            signal.signal(number, handler)
