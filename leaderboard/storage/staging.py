"""Staging folders for incoming submissions."""

import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final, Self

from colift.agents.submissions.folder import read_folder
from colift.agents.submissions.submission import Submission
from colift.base.errors import InputError
from colift.leaderboard.storage.files import sync, sync_tree

if sys.platform != "win32":
    import fcntl

PREFIX: Final = ".new-"
"""Prefix of the name of such a folder."""

_LOCK: Final = "lock"
"""A file in it, whose lock a process holds while it works there."""


@contextmanager
def staging(parent: Path) -> Iterator[Path]:
    """Yield a new folder in another one; remove it at the end with its remaining content."""
    place, lock = _locked(parent)
    try:
        yield place
    finally:
        shutil.rmtree(place, ignore_errors=True)
        os.close(lock)


def remove_abandoned(parent: Path) -> None:
    """Remove the folders of processes that were killed during their work."""
    for place in parent.glob(f"{PREFIX}*"):
        try:
            lock = _opened(place)
        except FileNotFoundError:
            continue  # It has just been removed.
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            shutil.rmtree(place, ignore_errors=True)
        except BlockingIOError:
            pass  # Somebody is at work there.
        finally:
            os.close(lock)


def _opened(place: Path) -> int:
    return os.open(place / _LOCK, os.O_WRONLY | os.O_CREAT | os.O_CLOEXEC, 0o600)


def _locked(parent: Path) -> tuple[Path, int]:
    """Return a new folder and the descriptor that holds its lock."""
    while True:
        place = Path(tempfile.mkdtemp(dir=parent, prefix=PREFIX))
        try:
            lock = _opened(place)
        except FileNotFoundError:
            continue  # A sweep was quicker than the lock.
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if (place / _LOCK).exists():
                return place, lock
        except BlockingIOError:
            pass
        os.close(lock)


@dataclass(frozen=True)
class Incoming:
    """A submission that can be put in its place at once: all slow work has been done."""

    submission: Submission
    target: Path
    """Its place."""
    spoilt: bool
    """Whether the place has other content, such as remains after a power failure."""

    @classmethod
    def of(cls, submission: Submission, target: Path) -> Self:
        """Return a submission on its way to a place; wait until its files are on the disk."""
        there = target.is_dir()
        intact = there and _digest(target) == submission.contents.digest
        if not intact:
            sync_tree(submission.folder)
        return cls(submission, target, spoilt=there and not intact)

    def place(self) -> Submission:
        """Put the files in their place, and return them there; equal ones that are there stay."""
        if self.spoilt:
            self.target.rename(self.submission.folder.with_name("spoilt"))
        if self.target.is_dir():
            os.utime(self.target)  # It is wanted again: a sweep leaves it.
        else:
            self.submission.folder.rename(self.target)
            sync(self.target.parent)
        return replace(self.submission, folder=self.target)


def _digest(folder: Path) -> str | None:
    try:
        return read_folder(folder).digest
    except InputError:
        return None
