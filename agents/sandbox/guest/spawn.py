"""The processes of a policy: one that watches, and its child, in which it is loaded, restricted.

The fork server forks the first process of new namespaces, which mounts fresh file systems and
watches; its child drops all privileges and runs the policy. Without namespaces the other
restrictions remain: Landlock, the filter, the limits.
"""

import contextlib
import os
import shutil
import signal
import socket
import tempfile
import traceback
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import NamedTuple

from colift.agents.sandbox.guest import linux
from colift.agents.sandbox.guest.filters import CHANNEL
from colift.agents.sandbox.guest.gate import Gate
from colift.agents.sandbox.guest.pages import Pages
from colift.agents.sandbox.guest.processes import Processes
from colift.agents.sandbox.guest.restrictions import (
    NOBODY,
    Restrictions,
    drop_privileges,
    enter_root,
)
from colift.agents.sandbox.guest.watch import Watch


class Ends(NamedTuple):
    """File descriptors of an episode."""

    data: int
    """The policy's end of the connection."""
    output: int
    """Its stdout and stderr."""
    status: int
    """Stream socket for the first process's reports and orders; if its other side closes, all
    processes end."""


def spawn(
    restrictions: Restrictions, ends: Ends, serve: Callable[[bool], None], pages: Pages
) -> None:
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
            _guarded(ends.status, partial(step, restrictions, ends, serve, pages))
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


def _detach(
    restrictions: Restrictions, ends: Ends, serve: Callable[[bool], None], pages: Pages
) -> None:
    """Enter new user and process namespaces, as the intermediate process."""
    if restrictions.namespaces:
        user, group = os.geteuid(), os.getegid()
        linux.hide(False)  # A hidden process's files in /proc belong to the superuser.
        linux.unshare(linux.CLONE_NEWUSER | linux.CLONE_NEWPID)
        Path("/proc/self/setgroups").write_text("deny")
        Path("/proc/self/uid_map").write_text(f"{user} {user} 1")
        Path("/proc/self/gid_map").write_text(f"{group} {group} 1")
    if os.fork() == 0:
        _guarded(ends.status, partial(_supervise, restrictions, ends, serve, pages))


def _supervise(
    restrictions: Restrictions, ends: Ends, serve: Callable[[bool], None], pages: Pages
) -> None:
    """Make the root directory, start the policy and watch it, as the first process."""
    linux.hide(True)
    if restrictions.namespaces:
        linux.unshare(linux.CLONE_OTHERS)
        processes = enter_root(restrictions)
    else:
        linux.prctl(linux.PR_SET_CHILD_SUBREAPER, 1)
        processes = os.open("/proc", os.O_RDONLY | os.O_DIRECTORY)
    here, there = socket.socketpair()
    child = os.fork()
    if child == 0:
        here.close()
        _guarded(ends.status, partial(_serve, restrictions, ends, serve, there))
    signal.signal(signal.SIGPIPE, signal.SIG_IGN)  # A closed connection must not end the watch.
    own = Processes(processes)
    own.all()
    there.close()
    connection, output = (os.fstat(end).st_ino for end in (ends.data, ends.output))
    for end in (ends.data, ends.output):
        os.close(end)
    with here:
        if here.recv(1) and restrictions.namespaces == "root":
            for name in ("uid_map", "gid_map"):
                _tell(own, child, name, f"0 0 1\n{NOBODY} {NOBODY} 1\n")
        # If a control group is full, the kernel should end the policy, not what watches it.
        with contextlib.suppress(OSError):
            _tell(own, child, "oom_score_adj", "1000")
        with contextlib.suppress(OSError):
            here.send(b"m")
        _, listeners, _, _ = socket.recv_fds(here, 1, 1)
    devices = [os.stat(each).st_dev for each in restrictions.fresh]  # noqa: PTH116
    fresh = frozenset(f"{os.major(each):02x}:{os.minor(each):02x}" for each in devices)
    Watch(
        loaded=child,
        status=ends.status,
        processes=own,
        limits=restrictions.limits,
        fresh=restrictions.fresh,
        gate=Gate(listeners[0], own, child, connection, output, fresh, pages, restrictions.doors)
        if listeners
        else None,
    ).run()
    if restrictions.scratch:
        shutil.rmtree(restrictions.scratch, ignore_errors=True)


def _tell(processes: Processes, process: int, name: str, words: str) -> None:
    """Write one of a process's files in /proc."""
    with processes.opened(process, name, os.O_WRONLY) as file:
        os.write(file, words.encode())


def _serve(
    restrictions: Restrictions,
    ends: Ends,
    serve: Callable[[bool], None],
    first: socket.socket,
) -> None:
    """Drop all privileges and serve, as the policy's process."""
    os.setsid()
    if restrictions.namespaces == "root":
        linux.unshare(linux.CLONE_NEWUSER)
    first.send(b"u")
    if not first.recv(1):
        raise OSError("the first process of the episode has ended")
    os.chdir(restrictions.folder or restrictions.scratch or "/tmp")
    if restrictions.scratch:
        tempfile.tempdir = os.environ["HOME"] = os.environ["TMPDIR"] = str(restrictions.scratch)
    os.sched_setaffinity(0, (linux.libc.sched_getcpu(),))
    listener = drop_privileges(restrictions)
    if listener is not None:
        socket.send_fds(first, [b"l"], [listener])
    # Keep the connection and the output, and close every other file.
    first.detach()
    os.dup2(os.open("/dev/null", os.O_RDONLY), 0)
    os.dup2(ends.output, 1)
    os.dup2(ends.output, 2)
    os.dup2(ends.data, CHANNEL)
    os.closerange(CHANNEL + 1, os.sysconf("SC_OPEN_MAX"))
    try:
        serve(listener is not None)
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(0)
