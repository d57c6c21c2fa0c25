"""The processes of an episode: one that watches, and its child, the policy's, restricted.

The fork server forks the first process of new namespaces, which mounts fresh file systems and
watches; its child drops all privileges and runs the policy. Without namespaces the other
restrictions remain: Landlock, the filter, the limits.
"""

import contextlib
import os
import shutil
import signal
import socket
import sys
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Final, NamedTuple

from . import linux
from .restrictions import NOBODY, Restrictions, drop_privileges, enter_root
from .watch import Watch

if sys.platform != "win32":
    import resource

_DATA: Final = 3
"""File descriptor of the policy's end of the connection."""


class Ends(NamedTuple):
    """File descriptors of an episode."""

    data: int
    """The policy's end of the connection."""
    output: int
    """Its stdout and stderr."""
    status: int
    """Stream socket for the first process's report; if its other side closes, all processes end."""


def spawn(restrictions: Restrictions, ends: Ends, serve: Callable[[int], None]) -> None:
    """Start the processes of an episode, return at once, and close the ends, which are theirs now.

    The superuser forks the first process directly into its namespace. Any other user must first
    enter a user namespace, which cannot be undone: an intermediate process does that.
    """
    first = restrictions.namespaces == "root"
    try:
        if first:
            linux.unshare(linux.CLONE_NEWPID)
        if os.fork() == 0:
            for number in (signal.SIGCHLD, signal.SIGINT, signal.SIGTERM, signal.SIGPIPE):
                signal.signal(number, signal.SIG_DFL)
            step = _supervise if first else _detach
            _guarded(ends.status, partial(step, restrictions, ends, serve))
        if first:
            linux.join("/proc/self/ns/pid", linux.CLONE_NEWPID)
    finally:
        for end in ends:
            os.close(end)


def _guarded(status: int, step: Callable[[], None]) -> None:
    """Take a step and end this process; a failure is reported as a fault of the machine."""
    try:
        step()
        os._exit(0)
    except BaseException as error:
        with contextlib.suppress(OSError):
            os.write(status, f"fault {type(error).__name__}: {error}\n".encode()[:500])
        os._exit(70)


def _detach(restrictions: Restrictions, ends: Ends, serve: Callable[[int], None]) -> None:
    """Enter new user and process namespaces, as the intermediate process."""
    if restrictions.namespaces:
        user, group = os.geteuid(), os.getegid()
        linux.hide(False)  # A hidden process's files in /proc belong to the superuser.
        linux.unshare(linux.CLONE_NEWUSER | linux.CLONE_NEWPID)
        Path("/proc/self/setgroups").write_text("deny")
        Path("/proc/self/uid_map").write_text(f"{user} {user} 1")
        Path("/proc/self/gid_map").write_text(f"{group} {group} 1")
    if os.fork() == 0:
        _guarded(ends.status, partial(_supervise, restrictions, ends, serve))


def _supervise(restrictions: Restrictions, ends: Ends, serve: Callable[[int], None]) -> None:
    """Make the root directory, start the policy and watch it, as the first process."""
    linux.hide(True)
    if restrictions.namespaces:
        linux.unshare(linux.CLONE_OTHERS)
        processes = enter_root(restrictions)
    else:
        linux.prctl(linux.PR_SET_CHILD_SUBREAPER, 1)
        processes = os.open("/proc", os.O_RDONLY | os.O_DIRECTORY)
    here, there = (end.detach() for end in socket.socketpair())
    child = os.fork()
    if child == 0:
        os.close(here)
        _guarded(ends.status, partial(_serve, restrictions, ends, serve, there))
    signal.signal(signal.SIGPIPE, signal.SIG_IGN)  # A closed connection must not end the watch.
    for end in (there, ends.data, ends.output):
        os.close(end)
    if os.read(here, 1) and restrictions.namespaces == "root":
        for name in ("uid_map", "gid_map"):
            _tell(processes, f"{child}/{name}", f"0 0 1\n{NOBODY} {NOBODY} 1\n")
    # If a control group is full, the kernel should end the policy, not the processes that watch it.
    with contextlib.suppress(OSError):
        _tell(processes, f"{child}/oom_score_adj", "1000")
    with contextlib.suppress(OSError):
        os.write(here, b"m")
    os.close(here)
    Watch(child, ends.status, processes, restrictions.limits, restrictions.fresh).run()
    if restrictions.scratch:
        for left in os.scandir(restrictions.scratch):
            if left.is_dir(follow_symlinks=False):
                shutil.rmtree(left, ignore_errors=True)
            else:
                os.unlink(left)  # noqa: PTH108 - a link, whatever it names


def _tell(processes: int, path: str, words: str) -> None:
    """Write a file of /proc, given by a handle."""
    file = os.open(path, os.O_WRONLY, dir_fd=processes)
    try:
        os.write(file, words.encode())
    finally:
        os.close(file)


def _serve(
    restrictions: Restrictions, ends: Ends, serve: Callable[[int], None], first: int
) -> None:
    """Drop all privileges and serve, as the policy's process."""
    os.setsid()
    if restrictions.namespaces == "root":
        linux.unshare(linux.CLONE_NEWUSER)
    os.write(first, b"u")
    if not os.read(first, 1):
        raise OSError("the first process of the episode has ended")
    os.chdir(restrictions.folder or restrictions.scratch or "/tmp")
    if restrictions.scratch:
        tempfile.tempdir = os.environ["HOME"] = os.environ["TMPDIR"] = str(restrictions.scratch)
    os.sched_setaffinity(0, (linux.libc.sched_getcpu(),))
    drop_privileges(restrictions)
    # Keep the connection and the output, and close every other file.
    os.dup2(os.open("/dev/null", os.O_RDONLY), 0)
    os.dup2(ends.output, 1)
    os.dup2(ends.output, 2)
    os.dup2(ends.data, _DATA)
    os.closerange(_DATA + 1, resource.getrlimit(resource.RLIMIT_NOFILE)[1])
    try:
        serve(_DATA)
    finally:
        os._exit(0)
