"""The start of the ``colift`` command: Ctrl-C while it loads, and while it ends, says nothing.

Nothing has begun while libraries are imported, which takes up to a second; an interrupt inside an
import would end in the library's traceback. For the same reason this module imports next to
nothing.
"""

import os
import signal

INTERRUPTED = 130
"""Exit code of an interrupted command, as in shells."""


class Loading:
    """While its body imports something, Ctrl-C ends the process at once.

    An interrupt that is ignored, or that somebody else handles, stays so.
    """

    def __enter__(self) -> None:
        """Take over Ctrl-C."""
        self._ours = False
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            try:
                signal.signal(signal.SIGINT, lambda *_: os._exit(INTERRUPTED))
                self._ours = True
            except ValueError:
                pass  # Only the main thread can, and only it would be interrupted.

    def __exit__(self, *error: object) -> None:
        """Give Ctrl-C back."""
        if self._ours:
            signal.signal(signal.SIGINT, signal.default_int_handler)


def start() -> None:
    """Load and run the command line."""
    with Loading():
        from .main import main
    try:
        main()
    finally:
        # The result is out: what still ends has nothing to say.
        signal.signal(signal.SIGINT, signal.SIG_IGN)
