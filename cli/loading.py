"""Ctrl-C while libraries are imported: the process ends at once, and says nothing.

Nothing has begun then; an interrupt inside an import would end in the library's traceback. For the
same reason this module imports next to nothing.
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
