"""The protocol between the host and the guest of a sandbox: limits, orders and frames.

A frame is a length (4 bytes, big-endian) and a msgpack list of numbers, strings and lists of these.
Pickle, arrays and extension types are not allowed: a received frame is a list, or an error.
"""

import math
import socket
import struct
import threading
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Final, NamedTuple

import msgpack
from colift.base.errors import InputError

AGENTS: Final = Path(__file__).resolve().parents[1]
"""``colift.agents``, of which the guest sees all but the humans."""

SHOWN: Final = (AGENTS.with_name("base").resolve(), AGENTS)
"""The parts of colift that the guest sees, in the order of their imports."""

OURS: Final = "colift.agents."
"""Prefix of the modules of colift's own policies; a submission's folder has no code for them."""

FORK: Final = "lift"
END: Final = "end"
"""Orders to the process that watches: let a lift be forked, and end it. The third order is a
number: the only processor that the policy may use from then on."""

CLOSED: Final = "closed"
ENDED: Final = "ended"
OF_LIFT: Final = "lift "
"""Its reports: a gate is closed, a lift has ended. The others are the reason for an end: ``exit
CODE``, ``signal NUMBER``, ``memory BYTES``, ``processes NUMBER``, ``processor SECONDS``, ``refused
REASON``, ``fault TEXT``; that of a lift alone begins with :data:`OF_LIFT`."""

ORDER: Final = 1 << 17
"""Longest order to a fork server, and its longest settings [bytes]."""

SECRETS: Final = "secrets.json"
"""File in the folder of the probe. It names ``files`` that must not be readable, a ``directory``
that must not be writable, a ``port`` on loopback and a ``socket`` in the file system that must not
be reached, a ``process`` that must not be seen or signalled, ``processes``, the name of its process
namespace, ``processors`` that must not be taken, and ``shared``, a file that policies may read and
must not mark."""

INTERNALS: Final = 64
"""Largest number of internals of a policy."""

NAME: Final = 64
"""Characters of an internal's name."""

MIB: Final = 2**20

OUTPUT: Final = 10_000
"""Characters of a policy's output that are kept: the last ones."""

REASON: Final = 500
"""Characters of a reason for a failure that are kept."""


@dataclass(frozen=True, kw_only=True)
class Limits:
    """Budgets of a policy in one episode. They are backstops: wall clock never enters a score.

    Budgets of time follow from the control period: a lift of n steps may take ``start_seconds + n *
    pace_seconds`` in all, import included.
    """

    memory: int = 2048 * MIB
    """Memory of all its processes together [bytes]."""
    processes: int = 64
    """Processes and threads at a time."""
    files: int = 256
    """Open files of a process."""
    file_size: int = 64 * MIB
    """Largest file, and size of its private /tmp and of its /dev/shm [bytes]."""
    cpu_seconds: int = 60
    """Processor time of a process [s]: as much as the wall time of the longest lift of a suite
    (10 s)."""
    start_seconds: float = 30.0
    """Wall time for import, constructor and ``reset`` together [s]; the steps may use the rest."""
    period: float = 0.1
    """Control period of the episode [s]; that of the suites."""
    step_periods: float = 100.0
    """Wall time for one action, in control periods: long enough for an overloaded machine. A slow
    policy is stopped by the budget of all actions together."""
    pace_periods: float = 3.0
    """Wall time that each action adds to the budget of all, in control periods."""

    def __post_init__(self) -> None:
        """Raise InputError if a limit is not a positive number."""
        for name, value in asdict(self).items():
            if not 0 < value < math.inf:
                raise InputError(f"limit {name} must be a positive number, got {value}")

    @property
    def step_seconds(self) -> float:
        """Wall time for an action [s]."""
        return self.step_periods * self.period

    @property
    def pace_seconds(self) -> float:
        """Wall time that each action adds to the budget of all [s]."""
        return self.pace_periods * self.period


LIMITS: Final = Limits()

FRAME: Final = 64 * 1024
"""Longest frame [bytes]."""

_FLAGS: Final = getattr(socket, "MSG_NOSIGNAL", 0) | getattr(socket, "MSG_DONTWAIT", 0)
_LENGTH: Final = struct.Struct(">I")
_CHUNK: Final = 4 * 1024


class Assignment(NamedTuple):
    """A policy to serve."""

    origin: str
    """Place of its class: ``module:Class`` or ``file.py:Class``."""
    parameters: str = ""
    """Its parameters: ``name=value,name=value``."""
    size: int = 1
    """Length of its actions."""


class WireError(Exception):
    """A message that breaks the protocol; the text is the reason."""


class ClosedError(WireError):
    """The other side has closed the connection."""


class _Local(threading.local):
    def __init__(self) -> None:
        self.pack = msgpack.Packer().pack


_LOCAL: Final = _Local()
"""One packer per thread, kept because a new one must allocate its buffer."""


def packed(content: list[Any]) -> bytes:
    """Return a list as a frame; raise WireError if it is too long or has other types."""
    try:
        body: bytes = _LOCAL.pack(content)
    except (TypeError, ValueError, OverflowError) as error:
        raise WireError(f"cannot be sent: {error}") from None
    if len(body) > FRAME:
        raise WireError(f"a message of {len(body)} bytes; at most {FRAME} are allowed")
    return _LENGTH.pack(len(body)) + body


def unpacked(body: bytes) -> list[Any]:
    """Return the list in the body of a frame; raise WireError if it is anything else."""
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
        """Send a frame without waiting; raise ClosedError if the other side does not accept it."""
        try:
            sent = self._end.send(frame, _FLAGS)
        except BlockingIOError:
            sent = 0
        except OSError:
            raise ClosedError("closed the connection") from None
        if sent != len(frame):
            raise ClosedError("does not read what it is sent")

    def fetch(self) -> list[Any] | None:
        """Wait for more bytes; return the frame, or None if it is still incomplete.

        Raise WireError if it is too long, is followed by more, or is not msgpack.
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
        """A message about an incomplete frame; empty if there is none."""
        return f"sent {len(self._buffer)} bytes of an answer, then no more" if self._buffer else ""

    def receive(self) -> list[Any]:
        """Wait for the next frame and return it; raise WireError as :meth:`fetch`."""
        while (content := self.fetch()) is None:
            pass
        return content
