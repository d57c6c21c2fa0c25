"""Records of a file: each whole or absent, whatever happened while it was written.

A record is ``length of the payload (4 bytes) | CRC-32 of length and payload (4 bytes) | payload``,
numbers little-endian, the payload msgpack. A file of records only grows: what was written before a
crash can be read after it.
"""

import os
import struct
import zlib
from collections.abc import Iterator
from dataclasses import fields
from typing import Any, BinaryIO, Final

import msgpack
import numpy as np
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.trace import Trace
from numpy.typing import NDArray


def record_of(episode: Episode) -> dict[str, Any]:
    """Return an episode as numbers, texts and bytes."""
    trace = episode.trace
    return {
        **{each.name: getattr(episode, each.name) for each in fields(Episode)},
        "seed": str(episode.seed),  # A hidden seed has more bits than msgpack's numbers.
        "scores": dict(episode.scores),
        "trace": {
            **{name: _packed(getattr(trace, name)) for name in (*Trace.series(), "state")},
            "added": {name: _packed(values) for name, values in trace.added.items()},
            "internals": {name: _packed(values) for name, values in trace.internals.items()},
        },
    }


def episode_of(content: dict[str, Any]) -> Episode:
    """Return the episode of a record; the inverse of :func:`record_of`."""
    arrays = dict(content["trace"])
    added, internals = (
        {name: _unpacked(values) for name, values in arrays.pop(kind).items()}
        for kind in ("added", "internals")
    )
    trace = {name: _unpacked(values) for name, values in arrays.items()}
    return Episode(
        **{
            **content,
            "seed": int(content["seed"]),
            "trace": Trace(**trace, added=added, internals=internals),
            "step_times": tuple(content["step_times"]),
        }
    )


def _packed(values: NDArray[Any]) -> list[Any]:
    return [values.dtype.str, list(values.shape), values.tobytes()]


def _unpacked(content: list[Any]) -> NDArray[Any]:
    kind, shape, data = content
    return np.frombuffer(data, np.dtype(kind)).reshape(shape).copy()


HEAD: Final = struct.Struct("<II")


def append_record(handle: int, content: Any) -> None:
    """Append a record to an open file, without a buffer in this process.

    Raises
    ------
    OSError
        If it cannot be written; the file may then end with a part of it.
    """
    payload = msgpack.packb(content, unicode_errors="surrogatepass")
    data = HEAD.pack(len(payload), _checksum(payload)) + payload
    while data:
        data = data[os.write(handle, data) :]


def records(file: BinaryIO, begin: int = 0) -> Iterator[tuple[Any, int]]:
    """Yield the content of each complete record from an offset on, and the offset of its end.

    Reading stops at the first record that is cut off or does not match its checksum.
    """
    size = file.seek(0, os.SEEK_END)
    while begin + HEAD.size <= size:
        file.seek(begin)
        length, checksum = HEAD.unpack(file.read(HEAD.size))
        begin += HEAD.size + length
        payload = file.read(length) if begin <= size else b""
        if len(payload) != length or _checksum(payload) != checksum:
            return
        yield msgpack.unpackb(payload, unicode_errors="surrogatepass"), begin


def _checksum(payload: bytes) -> int:
    # The length is included, so that zeros, which a crash can leave, are not a valid record.
    return zlib.crc32(payload, zlib.crc32(len(payload).to_bytes(4, "little")))
