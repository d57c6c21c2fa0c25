"""Standard streams that every command can write to, whatever it was started with."""

import contextlib
import os
import sys
from typing import Final

STREAMS: Final = (("stdin", "r"), ("stdout", "w"), ("stderr", "w"))
"""The standard streams by their file descriptors, with their modes."""


def complete_streams() -> None:
    """Open missing standard streams on the null device, and let stdout replace what it cannot show.

    Python has no stream for a descriptor that was closed at the start (``2>&-``). The next file
    would take its number, and be written to in its stead.
    """
    for number, (name, mode) in enumerate(STREAMS):
        if getattr(sys, name) is None:
            _open_null(number)
            setattr(sys, name, open(number, mode, encoding="utf-8", closefd=False))  # noqa: SIM115
    reconfigure = getattr(sys.stdout, "reconfigure", None)  # A test may have its own.
    if reconfigure is not None:
        reconfigure(errors="replace")


def give_up_stdout() -> None:
    """Send all further output to the null device: the reader of stdout is gone.

    Without this, Python reports that the rest of the output cannot be written when it exits.
    """
    with contextlib.suppress(OSError, ValueError):
        _open_null(sys.stdout.fileno())


def _open_null(number: int) -> None:
    """Let a file descriptor be the null device."""
    null = os.open(os.devnull, os.O_RDWR)
    if null != number:
        os.dup2(null, number)
        os.close(null)
