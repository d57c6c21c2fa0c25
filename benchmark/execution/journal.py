"""The journal of a run, with its finished episodes: an interrupted run resumes from it."""

import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

from colift.agents.submissions.folder import unwritable
from colift.base.errors import InputError, Remedy
from colift.benchmark.episode.loop import Episode
from colift.benchmark.execution.records import append_record, episode_of, records
from colift.benchmark.execution.shelf import EpisodeFile

if sys.platform != "win32":
    import fcntl

FORMAT: Final = "journal 1"


class Journal(EpisodeFile):
    """An open journal; see :func:`open_journal`."""

    def __init__(self, path: Path, handle: int) -> None:
        super().__init__(path, handle)
        self.done: dict[int, Episode] = {}
        """The episodes that were finished earlier, by their place in the suite."""

    def begin(self, run: Mapping[str, str], *, resume: bool) -> None:
        """Find the episodes in the file, which then ends with a complete record.

        Raises
        ------
        InputError
            As :func:`open_journal`.
        """
        found = records(self.file)
        head, end = next(found, (None, 0))
        size = os.fstat(self.handle).st_size
        if size and not (isinstance(head, dict) and "format" in head):
            raise InputError(
                f"{self.path} is not a journal of colift; delete it or name another folder"
            )
        if resume and head is not None:
            _compare(self.path, head, run)
            for (index, content), after in found:
                self.done[index] = self.shelved(episode_of(content), end)
                end = after
            os.truncate(self.handle, end)
            return
        lifts = sum(1 for _ in found)
        if lifts:
            raise InputError(
                f"{self.path} holds {lifts} lifts of an interrupted run; resume it, name another "
                "folder, or delete that file",
                remedy=Remedy.RESUME,
            )
        try:
            os.truncate(self.handle, 0)
            append_record(self.handle, dict(run))
        except OSError as error:
            raise unwritable(self.path, error) from error

    def remove(self) -> None:
        """Delete the file: the run is complete, and its result is written."""
        self.path.unlink(missing_ok=True)


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
        raise unwritable(path, error) from error
    try:
        _lock(handle, path)
        journal = Journal(path, handle)
        journal.begin({"format": FORMAT, **run}, resume=resume)
        yield journal
    finally:
        os.close(handle)


def _lock(handle: int, path: Path) -> None:
    if sys.platform == "win32":
        return  # It has locks of another kind.
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise InputError(f"another process with the same run writes to {path}") from None


def _compare(path: Path, then: Mapping[str, Any], now: Mapping[str, str]) -> None:
    """Raise an InputError that names the first difference, if there is one."""
    for name in dict.fromkeys((*now, *then)):
        before, here = then.get(name, "none"), now.get(name, "none")
        if before != here:
            raise InputError(
                f"the interrupted run had {name} {before!r}, this one has {here!r}; "
                f"run it as it was, name another folder, or delete {path}"
            )
