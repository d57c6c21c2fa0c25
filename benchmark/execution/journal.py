"""The journal of a run, with its finished episodes: an interrupted run resumes from it.

A record of the file is ``length of the payload (4 bytes) | CRC-32 of length and payload (4 bytes)
| payload``, numbers little-endian, the payload msgpack. The file only grows: what was written
before a crash can be read after it.
"""

import os
import struct
import sys
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import fields
from pathlib import Path
from typing import Any, Final

import msgpack
import numpy as np
from colift.agents.errors import InputError, Remedy
from colift.benchmark.episode.episode import Episode
from colift.benchmark.episode.trace import Trace
from numpy.typing import NDArray

if sys.platform != "win32":
    import fcntl

FORMAT: Final = "journal 1"


class Journal:
    """An open journal; see :func:`open_journal`."""

    def __init__(self, path: Path, handle: int, done: Mapping[int, Episode]) -> None:
        self._path = path
        self._handle = handle
        self.done = done
        """The episodes that were finished earlier, by their place in the suite."""

    def keep(self, place: int, episode: Episode) -> None:
        """Append an episode; once this returns, it outlives this process.

        Raises
        ------
        InputError
            If it cannot be written.
        """
        try:
            append_record(self._handle, [place, record_of(episode)])
        except OSError as error:
            raise _unwritable(self._path, error) from error

    def remove(self) -> None:
        """Delete the file: the run is complete, and its result is written."""
        self._path.unlink(missing_ok=True)


def journal_path(bundle: Path) -> Path:
    """Return the path of a run's journal: beside the bundle that the run will write."""
    return Path(f"{bundle.resolve()}.journal")


@contextmanager
def open_journal(bundle: Path, run: Mapping[str, str], *, resume: bool) -> Iterator[Journal]:
    """Yield the journal of a new run, or of one that was interrupted.

    Parameters
    ----------
    bundle
        The folder that the run will write.
    run
        Everything on which its episodes depend, by name: policy, suite, isolation, platform and so
        on.
    resume
        Whether to continue an interrupted run.

    Raises
    ------
    InputError
        If there is an interrupted run and ``resume`` is false, or there is none and ``resume`` is
        true; if the interrupted run differs from ``run``, with the difference in the message; if
        another process writes to the journal; or if it cannot be written.
    """
    path = journal_path(bundle)
    if resume and not path.exists():
        raise InputError(f"there is no interrupted run of {bundle} (no file {path})")
    try:
        handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o644)
    except OSError as error:
        raise _unwritable(path, error) from error
    try:
        _lock(handle, path)
        done = _begin(path, handle, {"format": FORMAT, **run}, resume)
        yield Journal(path, handle, done)
    finally:
        os.close(handle)


def _lock(handle: int, path: Path) -> None:
    if sys.platform == "win32":
        return  # It has locks of another kind.
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise InputError(f"another process with the same run writes to {path}") from None


def _begin(path: Path, handle: int, run: Mapping[str, str], resume: bool) -> dict[int, Episode]:
    """Return the episodes in the file, which then ends with a complete record."""
    data = path.read_bytes()
    found = list(records(data))
    if data and not (found and isinstance(found[0][0], dict) and "format" in found[0][0]):
        raise InputError(f"{path} is not a journal of colift; delete it or name another folder")
    if resume and found:
        _compare(path, found[0][0], run)
        os.truncate(handle, found[-1][1])
        return {place: episode_of(episode) for (place, episode), _ in found[1:]}
    if found[1:]:
        raise InputError(
            f"{path} holds {len(found) - 1} lifts of an interrupted run; resume it, name another "
            "folder, or delete that file",
            remedy=Remedy.RESUME,
        )
    try:
        os.truncate(handle, 0)
        append_record(handle, dict(run))
    except OSError as error:
        raise _unwritable(path, error) from error
    return {}


def _compare(path: Path, then: Mapping[str, Any], now: Mapping[str, str]) -> None:
    """Raise an InputError that names the first difference, if there is one."""
    for name in dict.fromkeys((*now, *then)):
        before, here = then.get(name, "none"), now.get(name, "none")
        if before != here:
            raise InputError(
                f"the interrupted run had {name} {before!r}, this one has {here!r}; "
                f"run it as it was, name another folder, or delete {path}"
            )


def _unwritable(path: Path, error: OSError) -> InputError:
    return InputError(f"cannot write to {path}: {error.strerror}")


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


def records(data: bytes) -> Iterator[tuple[Any, int]]:
    """Yield the content of each complete record, and the offset of its end.

    Reading stops at the first record that is cut off or does not match its checksum.
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
    # The length is included, so that zeros, which a crash can leave, are not a valid record.
    return zlib.crc32(payload, zlib.crc32(len(payload).to_bytes(4, "little")))
