"""The file systems of a cell that has namespaces: fresh ones that nobody else sees."""

import contextlib
import os
from pathlib import Path

from . import linux
from .linux import (
    MS_BIND,
    MS_NODEV,
    MS_NOEXEC,
    MS_NOSUID,
    MS_PRIVATE,
    MS_RDONLY,
    MS_REC,
    MS_REMOUNT,
)
from .view import AGENTS
from .walls import FRESH, Walls


def mount_fresh(walls: Walls) -> None:
    """Mount a /tmp, /dev/shm and /proc that only this cell sees, and cover what is hidden.

    Raises
    ------
    OSError
        If the kernel refuses.
    """
    linux.mount("none", "/", "", MS_REC | MS_PRIVATE)
    covered = [
        (path, os.open(path, os.O_PATH))
        for path in walls.readable
        if any(Path(each) in path.parents for each in FRESH)
    ]
    for place in FRESH:
        if Path(place).is_dir():
            size = walls.limits["file_size"]
            flags = MS_NOSUID | MS_NODEV
            linux.mount("tmpfs", place, "tmpfs", flags, f"size={size},nr_inodes=4096,mode=1777")
    for path, handle in covered:
        _show(path, handle)
        os.close(handle)
    agents = os.open(AGENTS, os.O_PATH)
    for path in walls.hidden:
        linux.mount("tmpfs", str(path), "tmpfs", MS_NOSUID | MS_NODEV, "size=4k,mode=755")
        if path in AGENTS.parents:
            _show(AGENTS, agents)
    os.close(agents)
    # Inside a container that covers parts of /proc this is refused: then the old one stays.
    with contextlib.suppress(OSError):
        linux.mount("proc", "/proc", "proc", MS_NOSUID | MS_NODEV | MS_NOEXEC)


def protect_proc() -> None:
    """Make /proc read-only; who maps the users of a namespace must have done so."""
    _protect("/proc", MS_NOEXEC)


def _show(path: Path, handle: int) -> None:
    """Bind what a handle names at its path again, where a fresh file system covers it."""
    source = f"/proc/self/fd/{handle}"
    if Path(source).is_dir():
        path.mkdir(parents=True, exist_ok=True)
    else:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    linux.mount(source, str(path), "", MS_BIND | MS_REC)
    _protect(str(path))


def _protect(place: str, more: int = 0) -> None:
    """Make what is mounted at a place read-only."""
    flags = MS_REMOUNT | MS_BIND | MS_RDONLY | MS_NOSUID | MS_NODEV | more
    linux.mount("none", place, "", flags)
