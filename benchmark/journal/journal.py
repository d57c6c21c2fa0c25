"""The file that a run's episodes are written to as they are finished."""

import fcntl
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

from ...agents.errors import InputError
from ..episode import Episode
from .packing import packed, unpacked
from .records import append_record, records

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
            append_record(self._handle, [place, packed(episode)])
        except OSError as error:
            raise _unwritable(self._path, error) from error

    def remove(self) -> None:
        """Delete the file: the run is complete, and its result is written."""
        self._path.unlink(missing_ok=True)


def journal_path(bundle: Path) -> Path:
    """Return where a run's journal lies: beside the bundle that the run will write."""
    return Path(f"{bundle.resolve()}.journal")


@contextmanager
def open_journal(bundle: Path, run: Mapping[str, str], *, resume: bool) -> Iterator[Journal]:
    """Yield the journal of a new run, or of one that was interrupted.

    Parameters
    ----------
    bundle
        The folder that the run will write.
    run
        What its episodes depend on, by name: policy, suite, isolation, platform and so on.
    resume
        Whether to go on with an interrupted run.

    Raises
    ------
    InputError
        If there is an interrupted run but ``resume`` is not asked for, or the other way round; if
        the interrupted run is another than ``run``: the message names what differs; if another
        process writes to the journal, or it cannot be written.
    """
    path = journal_path(bundle)
    if resume and not path.exists():
        raise InputError(f"--resume: there is no interrupted run of {bundle} (no file {path})")
    try:
        handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC, 0o644)
    except OSError as error:
        raise _unwritable(path, error) from error
    try:
        _lock(handle, path)
        done = _begin(path, handle, {"format": FORMAT, **run}, resume)
        yield Journal(path, handle, done)
    finally:
        os.close(handle)


def _lock(handle: int, path: Path) -> None:
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise InputError(f"another process is at this run: it writes to {path}") from None


def _begin(path: Path, handle: int, run: Mapping[str, str], resume: bool) -> dict[int, Episode]:
    """Return the episodes that are there; the file then ends with a whole record."""
    data = path.read_bytes()
    found = list(records(data))
    if data and not (found and isinstance(found[0][0], dict) and "format" in found[0][0]):
        raise InputError(f"{path} is not a journal of colift's; delete it or name another --out")
    if resume and found:
        _compare(path, found[0][0], run)
        os.truncate(handle, found[-1][1])
        return {place: unpacked(episode) for (place, episode), _ in found[1:]}
    if found[1:]:
        raise InputError(
            f"{path} holds {len(found) - 1} episodes of an interrupted run: go on with it by "
            "--resume, name another --out, or delete it"
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
                f"--resume: the interrupted run had {name} {before!r}, this one has {here!r}; "
                f"run it as it was, name another --out, or delete {path}"
            )


def _unwritable(path: Path, error: OSError) -> InputError:
    return InputError(f"cannot write to {path}: {error.strerror}")
