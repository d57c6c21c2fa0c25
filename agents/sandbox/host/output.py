"""The output of a policy, which nobody trusts: its end, without what a terminal would obey."""

import contextlib
import os
import re
from typing import Final
from unicodedata import category

from colift.agents.sandbox.protocol import OUTPUT

_CHUNK: Final = 64 * 1024
_CHUNKS: Final = 16
"""Most chunks per read: a policy that prints without end must not block the reader."""

_SEQUENCE: Final = re.compile(r"\x1b\[[0-?]*[ -/]*[@-~]")

_UNSEEN: Final = frozenset({"Cc", "Cf", "Cn", "Co", "Cs", "Zl", "Zp"})
"""Unicode categories of invisible characters, which can reverse, hide or split a text."""


def clean(text: str) -> str:
    """Return an untrusted text without invisible characters, except line ends and tabs.

    Invisible characters are control characters, marks and isolates of the direction of text,
    separators of lines and paragraphs, and private and unassigned characters.
    """
    shown = _SEQUENCE.sub("", text.encode(errors="replace").decode())
    if shown.isascii() and shown.isprintable():
        return shown
    return "".join(each for each in shown if each in "\n\t" or category(each) not in _UNSEEN)


class Output:
    """The reading end of a pipe; only the end of the output is kept."""

    def __init__(self, handle: int) -> None:
        os.set_blocking(handle, False)
        self._handle: int | None = handle
        self._tail = b""

    def drain(self) -> None:
        """Read the output so far, without waiting."""
        if self._handle is None:
            return
        with contextlib.suppress(BlockingIOError):
            for _ in range(_CHUNKS):
                chunk = os.read(self._handle, _CHUNK)
                if not chunk:
                    return
                # A character takes at most four bytes.
                self._tail = (self._tail + chunk)[-4 * OUTPUT :]

    def close(self) -> None:
        """Read the output so far, and close."""
        self.drain()
        if self._handle is not None:
            os.close(self._handle)
            self._handle = None

    @property
    def text(self) -> str:
        """The last characters of the output."""
        self.drain()
        return clean(self._tail.decode(errors="replace"))[-OUTPUT:]
