"""The restrictions of a policy's process: the root directory it sees, the privileges it drops."""

import contextlib
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from colift.agents.sandbox.guest import filters, landlock, linux
from colift.agents.sandbox.guest.linux import (
    MS_BIND,
    MS_NODEV,
    MS_NOEXEC,
    MS_NOSUID,
    MS_PRIVATE,
    MS_RDONLY,
    MS_REC,
)
from colift.agents.sandbox.protocol import SHOWN, Limits

FRESH: Final = ("/tmp", "/dev/shm")
"""Private directories of an episode with namespaces, empty at first."""

DEVICES: Final = ("/dev/null", "/dev/full", "/dev/random", "/dev/urandom")
"""Devices that a policy has; a shared mapping of /dev/zero would be memory of no process."""

NOBODY: Final = 65534

_BASE: Final = "/tmp"
"""Place of the new root directory; files that it covers are reached by their handles."""

RESERVED: Final = 2**30
"""Addresses of a process beyond its memory [bytes], for libraries and stacks of threads."""


@dataclass(frozen=True, kw_only=True)
class Restrictions:
    """The restrictions of a policy's process."""

    namespaces: str = ""
    """``root``: made by the superuser; ``user``: made by any user; empty: none."""
    landlock: bool
    readable: tuple[Path, ...]
    """Paths that it may read."""
    hidden: tuple[Path, ...]
    """Directories inside those that are covered."""
    folder: Path | None
    """Its folder, the working directory."""
    scratch: Path | None = None
    """Its writable directory, if it has no private /tmp."""
    limits: Limits
    doors: tuple[int, ...] = ()
    """A handle by which a process enters the control group of lifts, where there is one."""

    @property
    def fresh(self) -> tuple[str, ...]:
        """Its private directories."""
        return FRESH if self.namespaces else ()


def enter_root(restrictions: Restrictions) -> int:
    """Make a root directory that shows what the policy may see, and enter it.

    It is new, so that its times and numbers reveal no other episode. Everything in it is read-only,
    so that an episode leaves no trace on shared files, not even a time of access; only its own /tmp
    and /dev/shm are writable. Return a handle of a /proc that shows all processes of the episode,
    for the process that watches. Raise OSError if the kernel refuses.
    """
    linux.mount("none", "/", "", MS_REC | MS_PRIVATE)
    secure = MS_NOSUID | MS_NODEV | MS_NOEXEC
    # Inside a container that covers parts of /proc this is refused: the old /proc is used then.
    with contextlib.suppress(OSError):
        linux.mount("proc", "/proc", "proc", secure)
    processes = os.open("/proc", os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    links = {path: path.readlink() for path in restrictions.readable if path.is_symlink()}
    shown = {*restrictions.readable, *map(Path, DEVICES), *SHOWN} - links.keys()
    handles = {path: os.open(path, os.O_PATH | os.O_CLOEXEC) for path in shown if path.exists()}
    linux.mount("tmpfs", _BASE, "tmpfs", MS_NOSUID, "size=1m,mode=755")
    for place in ("/proc", *FRESH):
        Path(f"{_BASE}{place}").mkdir(parents=True)
    for place in FRESH:
        options = f"size={restrictions.limits.file_size},nr_inodes=4096,mode=1777"
        linux.mount("tmpfs", f"{_BASE}{place}", "tmpfs", MS_NOSUID | MS_NODEV, options)
    for path in (*restrictions.readable, *map(Path, DEVICES)):
        if path in handles:
            _show(path, handles[path])
        elif path in links:
            Path(f"{_BASE}{path}").symlink_to(links[path])
    for path in restrictions.hidden:
        linux.mount("tmpfs", f"{_BASE}{path}", "tmpfs", MS_NOSUID, "size=1m,mode=755")
        for part in SHOWN:
            if path in part.parents:
                _show(part, handles[part])
    for handle in handles.values():
        os.close(handle)
    linux.make_read_only(_BASE, True)
    for place in FRESH:
        linux.make_read_only(f"{_BASE}{place}", False)
    # A /proc of the policy's own processes; if that is refused, it stays empty.
    with contextlib.suppress(OSError):
        options = "subset=pid,hidepid=2"
        linux.mount("proc", f"{_BASE}/proc", "proc", secure | MS_RDONLY, options)
    linux.change_root(_BASE)
    return processes


def _show(path: Path, handle: int) -> None:
    """Bind the file or directory of a handle at its path beneath the new root directory."""
    source, target = f"/proc/self/fd/{handle}", Path(f"{_BASE}{path}")
    if os.path.isdir(source):  # noqa: PTH112 - a link to follow
        target.mkdir(parents=True, exist_ok=True)
    else:
        target.parent.mkdir(parents=True, exist_ok=True)
        target.touch()
    linux.mount(source, str(target), "", MS_BIND | MS_REC)


def drop_privileges(restrictions: Restrictions) -> int | None:
    """Restrict this process and all that it will start; raise OSError if the kernel refuses.

    Return the listener of the filter of system calls; None where there is no filter, which only a
    level without namespaces allows.
    """
    if restrictions.namespaces == "root":
        linux.become(NOBODY, NOBODY)
        # Without this capability the user ``nobody`` could not read private folders. It is valid in
        # the process's own user namespace only.
        linux.drop_capabilities(1 << linux.CAP_DAC_READ_SEARCH)
    else:
        linux.drop_capabilities()
    linux.prctl(linux.PR_SET_NO_NEW_PRIVS, 1)
    linux.hide(False)
    if restrictions.landlock:
        landlock.restrict(_rules(restrictions))
    try:
        listener = filters.install(filters.LOADING, listen=True)
    except OSError as error:
        if restrictions.namespaces:
            raise OSError(f"system calls cannot be filtered: {error}") from error
        listener = None
    _set_limits(restrictions)
    return listener


def _rules(restrictions: Restrictions) -> list[tuple[Path, int]]:
    """Return the paths that Landlock allows, with their rights."""
    shown = (Path("/"),) if restrictions.namespaces else restrictions.readable
    rules = [(path, landlock.READ) for path in shown]
    rules += [(Path(each), landlock.READ_FILE | landlock.WRITE_FILE) for each in DEVICES]
    writable = [Path(each) for each in restrictions.fresh]
    writable += [restrictions.scratch] if restrictions.scratch else []
    return rules + [(each, landlock.ALL & ~landlock.IOCTL) for each in writable]


def _set_limits(restrictions: Restrictions) -> None:
    import resource  # Windows, where this file is only read, has none.

    limits = restrictions.limits
    values = {
        # One byte: the kernel starts no program for a core dump, as it would for none.
        resource.RLIMIT_CORE: 1,
        resource.RLIMIT_FSIZE: limits.file_size,
        resource.RLIMIT_NOFILE: limits.files,
        resource.RLIMIT_CPU: limits.cpu_seconds,
        resource.RLIMIT_DATA: limits.memory,
        # RESERVED is for addresses that libraries and threads reserve without using them.
        resource.RLIMIT_AS: limits.memory + RESERVED,
    }
    if restrictions.namespaces:
        # Elsewhere the kernel would count all processes of the user, not only the policy's.
        values[resource.RLIMIT_NPROC] = limits.processes
    for kind, value in values.items():
        hard = resource.getrlimit(kind)[1]
        value = value if hard == resource.RLIM_INFINITY else min(value, hard)
        # A second after its signal, what passes the limit of processor time is killed.
        more = 1 if kind == resource.RLIMIT_CPU and value != hard else 0
        resource.setrlimit(kind, (value, value + more))
