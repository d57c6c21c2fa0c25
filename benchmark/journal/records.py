"""Records in a file that only grows: those written before a crash can be read after it.

A record is ``length of the payload (4 bytes) | CRC-32 of length and payload (4 bytes) | payload``,
numbers little-endian, the payload msgpack.
"""

import os
import struct
import zlib
from collections.abc import Iterator
from typing import Any, Final

import msgpack

HEAD: Final = struct.Struct("<II")


def append_record(handle: int, content: Any) -> None:
    """Write a record to the end of an open file, and hand it to the operating system.

    Raises
    ------
    OSError
        If it cannot be written; the file may then end with a part of it.
    """
    payload = msgpack.packb(content, unicode_errors="surrogatepass")
    data = HEAD.pack(len(payload), _checksum(payload)) + payload
    while data:
        data = data[os.write(handle, data) :]


def records(data: bytes) -> Iterator[tuple[Any, int]]:
    """Yield the content of each whole record, and where it ends.

    A record that was cut off, or does not fit its checksum, is the end: so is what comes after.
    """
    begin = 0
    while begin + HEAD.size <= len(data):
        length, checksum = HEAD.unpack_from(data, begin)
        begin += HEAD.size
        payload = data[begin : begin + length]
        if len(payload) != length or _checksum(payload) != checksum:
            return
        begin += length
        yield msgpack.unpackb(payload, unicode_errors="surrogatepass"), begin


def _checksum(payload: bytes) -> int:
    # With the length, since zeros, which a crash can leave, must not be a record.
    return zlib.crc32(payload, zlib.crc32(len(payload).to_bytes(4, "little")))
