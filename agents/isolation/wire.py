"""Frames: what a sandboxed policy and its episode tell each other.

A frame is its length (4 bytes, big-endian) and a msgpack list of numbers, words, lists of them.
No pickle, no arrays, no extension types; whatever arrives is a list, or an error.
"""

import socket
import struct
import threading
from typing import Any, Final

import msgpack

FRAME: Final = 64 * 1024
"""Longest frame [bytes]."""

_FLAGS: Final = socket.MSG_NOSIGNAL | socket.MSG_DONTWAIT
_LENGTH: Final = struct.Struct(">I")
_CHUNK: Final = 4 * 1024


class WireError(Exception):
    """What came is no answer; the message says why."""


class ClosedError(WireError):
    """The other side has closed."""


class _Local(threading.local):
    def __init__(self) -> None:
        self.pack = msgpack.Packer().pack


_LOCAL: Final = _Local()
"""A packer of each thread's own, kept: a new one has to get its buffer anew."""


def packed(content: list[Any]) -> bytes:
    """Return a list as a frame.

    Raises
    ------
    WireError
        If it is longer than a frame may be, or holds something that a frame cannot.
    """
    try:
        body: bytes = _LOCAL.pack(content)
    except (TypeError, ValueError, OverflowError) as error:
        raise WireError(f"cannot be sent: {error}") from None
    if len(body) > FRAME:
        raise WireError(f"a message of {len(body)} bytes; at most {FRAME} are allowed")
    return _LENGTH.pack(len(body)) + body


def unpacked(body: bytes) -> list[Any]:
    """Return the list in the body of a frame.

    Raises
    ------
    WireError
        If it is anything else.
    """
    try:
        content = msgpack.unpackb(body, max_ext_len=0, max_map_len=0)
    except Exception as error:  # msgpack has no common base class of its errors.
        raise WireError(f"not msgpack ({type(error).__name__})") from None
    if type(content) is not list:
        raise WireError(f"a {type(content).__name__} instead of a list")
    return content


class Channel:
    """One end of the connection. There is at most one unanswered request at a time.

    Parameters
    ----------
    end
        A stream socket. It may have a time limit for receiving (``SO_RCVTIMEO``); none is needed
        for sending.
    """

    def __init__(self, end: socket.socket) -> None:
        self._end = end
        self._buffer = b""

    def close(self) -> None:
        """Close this end."""
        self._end.close()

    def send(self, frame: bytes) -> None:
        """Send a frame; never wait.

        Raises
        ------
        ClosedError
            If the other side has closed, or has not read what came before.
        """
        try:
            sent = self._end.send(frame, _FLAGS)
        except BlockingIOError:
            sent = 0
        except OSError:
            raise ClosedError("closed the connection") from None
        if sent != len(frame):
            raise ClosedError("does not read what it is sent")

    def fetch(self) -> list[Any] | None:
        """Wait for what comes next; return the frame, or None if it is not all there yet.

        Raises
        ------
        WireError
            If it is too long, is followed by more, or is not msgpack.
        """
        try:
            chunk = self._end.recv(_CHUNK)
        except BlockingIOError:
            return None
        except OSError:
            raise ClosedError("closed the connection") from None
        if not chunk:
            raise ClosedError(self.partial or "closed the connection")
        self._buffer += chunk
        if len(self._buffer) < _LENGTH.size:
            return None
        (length,) = _LENGTH.unpack_from(self._buffer)
        if length > FRAME:
            raise WireError(f"a message of {length} bytes; at most {FRAME} are allowed")
        left = _LENGTH.size + length - len(self._buffer)
        if left > 0:
            return None
        if left < 0:
            raise WireError("more than one answer to a request")
        body, self._buffer = self._buffer[_LENGTH.size :], b""
        return unpacked(body)

    @property
    def partial(self) -> str:
        """What there is of an unfinished frame, in words; empty if nothing."""
        return f"sent {len(self._buffer)} bytes of an answer, then no more" if self._buffer else ""

    def receive(self) -> list[Any]:
        """Wait for the next frame and return it.

        Raises
        ------
        WireError
            As :meth:`fetch`.
        """
        while (content := self.fetch()) is None:
            pass
        return content
