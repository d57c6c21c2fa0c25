"""Memory control groups: the kernel's limit on the memory of all processes of a sandbox."""

import contextlib
import os
import time
from pathlib import Path
from typing import Final

ROOT: Final = Path("/sys/fs/cgroup")

_PREFIX: Final = "colift"
_LIMITS: Final = ("memory.max", "memory.limit_in_bytes")
"""File with the limit, in version 2 and 1 of control groups."""
_SWAP: Final = {"memory.swap.max": "0", "memory.swappiness": "0"}
"""Settings against swapping: swapped memory would not be charged."""
_REMOVE_SECONDS: Final = 1.0

_ENTER: Final = 'echo 0 >"$0/cgroup.procs" && exec "$@"'


class ControlGroup:
    """A control group below this process's own, with a limit on memory.

    The limit is on all memory [bytes] of its processes together, files in memory and page tables
    included. Raise OSError if this process may not make one, which usually only root and processes
    in delegated groups may.
    """

    def __init__(self, memory: int) -> None:
        parent = _own()
        _sweep(parent)
        self.folder = parent / f"{_PREFIX}-{os.getpid()}-{os.urandom(6).hex()}"
        self.folder.mkdir()
        try:
            limit = next((each for each in _LIMITS if (self.folder / each).exists()), None)
            if limit is None:
                raise OSError(f"{parent} does not limit the memory of groups below it")
            (self.folder / limit).write_text(str(memory))
        except OSError:
            self.remove()
            raise
        for name, value in _SWAP.items():
            with contextlib.suppress(OSError):
                (self.folder / name).write_text(value)

    def entering(self, command: list[str]) -> list[str]:
        """Return the command that enters the group and then runs another."""
        return ["/bin/sh", "-c", _ENTER, str(self.folder), *command]

    def door(self) -> int:
        """Return a handle; a process enters that whose number is written to it."""
        return os.open(self.folder / "cgroup.procs", os.O_WRONLY | os.O_CLOEXEC)

    def remove(self) -> None:
        """Remove the group, whose processes have ended or are about to."""
        end = time.monotonic() + _REMOVE_SECONDS
        while not _removed(self.folder) and time.monotonic() < end:
            time.sleep(0.01)


def _own() -> Path:
    """Return the folder of this process's group; OSError if it cannot be determined."""
    for line in Path("/proc/self/cgroup").read_text().splitlines():
        _, controllers, path = line.split(":", 2)
        mounted = {"memory": ROOT / "memory", "": ROOT}.get(controllers)
        if mounted is not None and (mounted / "cgroup.procs").exists():
            folder = mounted / path.lstrip("/")
            return folder if folder.is_dir() else mounted
    raise OSError("there are no control groups of memory")


def _sweep(parent: Path) -> None:
    """Remove the groups whose owners were killed."""
    for folder in parent.glob(f"{_PREFIX}-*-*"):
        if not Path("/proc", folder.name.split("-")[1]).exists():
            _removed(folder)


def _removed(folder: Path) -> bool:
    """Return whether a group is gone; one with processes in it cannot be removed."""
    with contextlib.suppress(OSError):
        folder.rmdir()
    return not folder.exists()
