"""What a policy prints: its end is kept, without what a terminal or a page would obey."""

import contextlib
import os
import re
from typing import Final

from .limits import OUTPUT

_CHUNK: Final = 64 * 1024
_CHUNKS: Final = 16
"""Chunks read at a time at most: a policy that never stops must not hold up who reads."""

_CONTROL: Final = re.compile(r"\x1b\[[0-?]*[ -/]*[@-~]|[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e]")


def clean(text: str) -> str:
    """Return a stranger's text without control characters, but for line ends and tabs."""
    return _CONTROL.sub("", text.encode(errors="replace").decode())


class Output:
    """The reading end of a pipe; memory does not grow with what is written."""

    def __init__(self, handle: int) -> None:
        os.set_blocking(handle, False)
        self._handle: int | None = handle
        self._tail = b""

    def drain(self) -> None:
        """Take in what has come, without waiting."""
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
        """Take in what has come, and close."""
        self.drain()
        if self._handle is not None:
            os.close(self._handle)
            self._handle = None

    @property
    def text(self) -> str:
        """The last characters of what has come."""
        self.drain()
        return clean(self._tail.decode(errors="replace"))[-OUTPUT:]
