"""A cell: the processes and walls around one policy for one episode.

The fork server forks the first process of new namespaces, which mounts fresh file systems and
watches; its child gives up all rights and runs the policy. Where namespaces cannot be had, the
walls are what is left: Landlock, the filter, the limits.
"""

import contextlib
import os
import resource
import shutil
import signal
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, NamedTuple

from . import landlock, linux, seccomp
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
from .watch import watch

AGENTS: Final = Path(__file__).resolve().parents[1]
NOBODY: Final = 65534
DATA: Final = 3
"""File descriptor of the policy's end of the connection."""

_FRESH: Final = ("/tmp", "/dev/shm")
_DEVICES: Final = ("/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom")
_NAMESPACES: Final = (
    linux.CLONE_NEWNS | linux.CLONE_NEWIPC | linux.CLONE_NEWNET | linux.CLONE_NEWUTS
)


@dataclass(frozen=True, kw_only=True)
class Walls:
    """What is around a policy."""

    namespaces: str
    """``root``: made by the superuser; ``user``: by anybody; empty: none."""
    landlock: bool
    seccomp: bool
    readable: tuple[Path, ...]
    """What it may read."""
    hidden: tuple[Path, ...]
    """What of that is to be covered."""
    mounted: bool
    """Whether the mounts show that and no more."""
    folder: Path | None
    """Its folder, where it starts."""
    scratch: Path | None
    """Where it may write if it has no private /tmp."""
    limits: dict[str, Any]
    """See :class:`.limits.Limits`."""


class Ends(NamedTuple):
    """File descriptors of an episode."""

    data: int
    """The policy's end of the connection."""
    output: int
    """Where its stdout and stderr go."""
    status: int
    """Where the first process reports: a stream socket; when its other side closes, all ends."""


def start(walls: Walls, ends: Ends, serve: Callable[[int], None]) -> None:
    """Start a cell that serves an episode; return at once.

    The superuser's first process is forked into its namespace directly; another must first become
    one that may make namespaces, which cannot be undone: so a process between does.
    """
    first = walls.namespaces == "root"
    if first:
        linux.unshare(linux.CLONE_NEWPID)
    if os.fork() == 0:
        for number in (signal.SIGCHLD, signal.SIGINT, signal.SIGTERM, signal.SIGPIPE):
            signal.signal(number, signal.SIG_DFL)
        step = _keep if first else _leave
        _guarded(ends.status, lambda: step(walls, ends, serve))
    if first:
        linux.join("/proc/self/ns/pid", linux.CLONE_NEWPID)
    for end in ends:
        os.close(end)


def _guarded(status: int, step: Callable[[], None]) -> None:
    """Take a step and end this process, with what failed told: it is the machine's fault."""
    try:
        step()
        os._exit(0)
    except BaseException as error:
        with contextlib.suppress(OSError):
            os.write(status, f"fault {type(error).__name__}: {error}\n".encode()[:500])
        os._exit(70)


def _leave(walls: Walls, ends: Ends, serve: Callable[[int], None]) -> None:
    """Between: leave the user and the processes of the fork server."""
    if walls.namespaces:
        user, group = os.geteuid(), os.getegid()
        linux.hide(False)  # Files in /proc of a hidden process are the superuser's.
        linux.unshare(linux.CLONE_NEWUSER | linux.CLONE_NEWPID)
        _map("self", f"{user} {user} 1", f"{group} {group} 1", deny=True)
    if os.fork() == 0:
        _guarded(ends.status, lambda: _keep(walls, ends, serve))


def _map(process: str, users: str, groups: str, *, deny: bool) -> None:
    """Say who the users of a new user namespace are outside."""
    place = Path("/proc") / process
    if deny:
        (place / "setgroups").write_text("deny")
    (place / "uid_map").write_text(users)
    (place / "gid_map").write_text(groups)


def _keep(walls: Walls, ends: Ends, serve: Callable[[int], None]) -> None:
    """The first process: mount what is fresh, start the policy's process, watch it."""
    linux.hide(True)
    if walls.namespaces:
        linux.unshare(_NAMESPACES)
        _mount(walls)
    else:
        linux.become_subreaper()
    unshared, mapped = os.pipe(), os.pipe()
    child = os.fork()
    if child == 0:
        for end in (unshared[0], mapped[1]):
            os.close(end)
        _guarded(ends.status, lambda: _serve(walls, ends, serve, unshared[1], mapped[0]))
    for end in (ends.data, ends.output, unshared[1], mapped[0]):
        os.close(end)
    if os.read(unshared[0], 1) and walls.namespaces == "root":
        both = f"0 0 1\n{NOBODY} {NOBODY} 1\n"
        _map(str(child), both, both, deny=False)
    if walls.namespaces:
        _protect("/proc", MS_NOEXEC)
    os.write(mapped[1], b"m")
    os.close(mapped[1])
    os.close(unshared[0])
    watch(
        child,
        ends.status,
        memory=walls.limits["memory"],
        processes=walls.limits["processes"],
    )
    if walls.scratch:
        for left in walls.scratch.iterdir():
            shutil.rmtree(left, ignore_errors=True) if left.is_dir() else left.unlink()


def _mount(walls: Walls) -> None:
    """Mount a /tmp, /dev/shm and /proc that only this cell sees."""
    linux.mount("none", "/", "", MS_REC | MS_PRIVATE)
    covered = [
        (path, os.open(path, os.O_PATH))
        for path in walls.readable
        if any(Path(each) in path.parents for each in _FRESH)
    ]
    for place in _FRESH:
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


def _serve(
    walls: Walls, ends: Ends, serve: Callable[[int], None], unshared: int, mapped: int
) -> None:
    """The policy's process: give up all rights, and serve."""
    os.setsid()
    if walls.namespaces == "root":
        linux.unshare(linux.CLONE_NEWUSER)
    os.write(unshared, b"u")
    if not os.read(mapped, 1):
        raise OSError("the cell's first process has ended")
    if walls.folder:
        os.chdir(walls.folder)
    elif walls.scratch:
        os.chdir(walls.scratch)
    else:
        os.chdir("/tmp")
    if walls.scratch:
        os.environ["HOME"] = os.environ["TMPDIR"] = str(walls.scratch)
    _give_up(walls)
    _arrange(ends)
    sys.stdout.flush()
    try:
        serve(DATA)
    finally:
        os._exit(0)


def _give_up(walls: Walls) -> None:
    limits = walls.limits
    if walls.namespaces == "root":
        linux.become(NOBODY, NOBODY)
        # It is nobody, but reads what only the superuser may of what it sees: folders are private.
        # The capability holds in its own user namespace only.
        linux.drop_capabilities(1 << linux.CAP_DAC_READ_SEARCH)
    else:
        linux.drop_capabilities()
    linux.forbid_new_privileges()
    linux.hide(False)
    if walls.landlock:
        landlock.restrict(_rules(walls))
    if walls.seccomp:
        seccomp.install()
    size, memory = limits["file_size"], limits["memory"]
    _limit(resource.RLIMIT_CORE, 0)
    _limit(resource.RLIMIT_FSIZE, size)
    _limit(resource.RLIMIT_NOFILE, limits["files"])
    _limit(resource.RLIMIT_CPU, limits["cpu_seconds"])
    _limit(resource.RLIMIT_DATA, memory)
    _limit(resource.RLIMIT_AS, 4 * memory)
    if walls.namespaces:
        _limit(resource.RLIMIT_NPROC, limits["processes"])


def _limit(kind: int, value: int) -> None:
    hard = resource.getrlimit(kind)[1]
    value = value if hard == resource.RLIM_INFINITY else min(value, hard)
    resource.setrlimit(kind, (value, value))


def _rules(walls: Walls) -> list[tuple[Path, int]]:
    """Return what Landlock allows."""
    shown = (Path("/"),) if walls.mounted else walls.readable
    rules = [(path, landlock.READ) for path in shown]
    rules += [(Path(each), landlock.READ_FILE | landlock.WRITE_FILE) for each in _DEVICES]
    rules += [(Path("/proc"), landlock.READ)] if walls.namespaces else []
    writable = [Path(each) for each in _FRESH] if walls.namespaces else []
    writable += [walls.scratch] if walls.scratch else []
    return rules + [(each, landlock.ALL & ~landlock.IOCTL) for each in writable]


def _arrange(ends: Ends) -> None:
    """Keep the connection and the output, and close every other file."""
    nothing = os.open("/dev/null", os.O_RDONLY)
    os.dup2(nothing, 0)
    os.dup2(ends.output, 1)
    os.dup2(ends.output, 2)
    os.dup2(ends.data, DATA)
    os.closerange(DATA + 1, resource.getrlimit(resource.RLIMIT_NOFILE)[1])
