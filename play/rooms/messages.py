"""The binary messages between a page and its room, little endian."""

import struct
from dataclasses import dataclass
from typing import Final

from colift.base.errors import InputError
from colift.play.rooms.live_lift import Shown

SAMPLES: Final = 1
"""Kind of a message with samples, page to room."""

FRAME_SHOWN: Final = 1
"""Kind of a message with a frame, room to page."""

LATE: Final = 1
"""Flag of a frame that was made after its time."""

STARVED: Final = 2
"""Flag of a frame for which the hand's next sample was missing."""

MOST_IN_A_MESSAGE: Final = 200
"""Most samples in one message."""

_HEAD: Final = struct.Struct("<BI")
_SAMPLE: Final = struct.Struct("<df")
_FRAME: Final = struct.Struct("<BBxxIfffI")


@dataclass(frozen=True, kw_only=True)
class HandSamples:
    """Samples of a hand, as sent by a page."""

    first: int
    """Number of the first sample since the grip."""
    samples: tuple[tuple[float, float], ...]
    """Time of the page's clock [s] and height above the grip [m]."""


def parse_samples(message: bytes) -> HandSamples:
    """Return the samples of a page's message.

    Raises
    ------
    InputError
        If it is not such a message.
    """
    count, rest = divmod(len(message) - _HEAD.size, _SAMPLE.size)
    if count < 0 or rest or count > MOST_IN_A_MESSAGE or message[0] != SAMPLES:
        raise InputError(
            f"a message with samples must have {_HEAD.size} bytes and {_SAMPLE.size} for each of "
            f"at most {MOST_IN_A_MESSAGE} samples, and begin with {SAMPLES}; got "
            f"{len(message)} bytes"
        )
    _, first = _HEAD.unpack_from(message)
    samples = tuple(
        (time / 1000, height) for time, height in _SAMPLE.iter_unpack(message[_HEAD.size :])
    )
    return HandSamples(first=first, samples=samples)


def dump_samples(content: HandSamples) -> bytes:
    """Return a page's message with samples."""
    head = _HEAD.pack(SAMPLES, content.first)
    return head + b"".join(_SAMPLE.pack(1000 * time, height) for time, height in content.samples)


def dump_frame(shown: Shown, *, flags: int, used: int) -> bytes:
    """Return the message of a frame, 24 bytes.

    Parameters
    ----------
    shown
        Content of the frame.
    flags
        :data:`LATE` and :data:`STARVED`.
    used
        Number of samples of the receiver's hand that have been used up to this frame.
    """
    return _FRAME.pack(
        FRAME_SHOWN,
        flags,
        shown.frame,
        shown.human_end,
        shown.robot_end,
        shown.human_force,
        used,
    )


def parse_frame(message: bytes) -> tuple[Shown, int, int]:
    """Return the content of a frame, its flags, and the number of used samples.

    Raises
    ------
    InputError
        If it is not such a message.
    """
    if len(message) != _FRAME.size or message[0] != FRAME_SHOWN:
        raise InputError(f"a frame's message must have {_FRAME.size} bytes, got {len(message)}")
    _, flags, frame, human, robot, force, used = _FRAME.unpack(message)
    return Shown(frame, human, robot, force), flags, used
