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
from collections.abc import Callable
from pathlib import Path
from typing import Final, NamedTuple

from . import linux
from .mounts import mount_fresh, protect_proc
from .rights import NOBODY, give_up
from .walls import Walls
from .watch import watch

_DATA: Final = 3
"""File descriptor of the policy's end of the connection."""

_NAMESPACES: Final = (
    linux.CLONE_NEWNS | linux.CLONE_NEWIPC | linux.CLONE_NEWNET | linux.CLONE_NEWUTS
)


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
    """Leave the user and the processes of the fork server: what the process between does."""
    if walls.namespaces:
        user, group = os.geteuid(), os.getegid()
        linux.hide(False)  # Files in /proc of a hidden process are the superuser's.
        linux.unshare(linux.CLONE_NEWUSER | linux.CLONE_NEWPID)
        Path("/proc/self/setgroups").write_text("deny")
        _map("self", f"{user} {user} 1", f"{group} {group} 1")
    if os.fork() == 0:
        _guarded(ends.status, lambda: _keep(walls, ends, serve))


def _map(process: str, users: str, groups: str) -> None:
    """Say who the users of a new user namespace are outside."""
    place = Path("/proc") / process
    (place / "uid_map").write_text(users)
    (place / "gid_map").write_text(groups)


def _keep(walls: Walls, ends: Ends, serve: Callable[[int], None]) -> None:
    """Mount what is fresh, start the policy's process, watch it: what the first process does."""
    linux.hide(True)
    if walls.namespaces:
        linux.unshare(_NAMESPACES)
        mount_fresh(walls)
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
        _map(str(child), both, both)
    if walls.namespaces:
        protect_proc()
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


def _serve(
    walls: Walls, ends: Ends, serve: Callable[[int], None], unshared: int, mapped: int
) -> None:
    """Give up all rights, and serve: what the policy's process does."""
    os.setsid()
    if walls.namespaces == "root":
        linux.unshare(linux.CLONE_NEWUSER)
    os.write(unshared, b"u")
    if not os.read(mapped, 1):
        raise OSError("the cell's first process has ended")
    os.chdir(walls.folder or walls.scratch or "/tmp")
    if walls.scratch:
        os.environ["HOME"] = os.environ["TMPDIR"] = str(walls.scratch)
    give_up(walls)
    _arrange(ends)
    try:
        serve(_DATA)
    finally:
        os._exit(0)


def _arrange(ends: Ends) -> None:
    """Keep the connection and the output, and close every other file."""
    nothing = os.open("/dev/null", os.O_RDONLY)
    os.dup2(nothing, 0)
    os.dup2(ends.output, 1)
    os.dup2(ends.output, 2)
    os.dup2(ends.data, _DATA)
    os.closerange(_DATA + 1, resource.getrlimit(resource.RLIMIT_NOFILE)[1])
