"""The probe: a process that tries, in place of a policy, all that a sandbox must prevent."""

import contextlib
import mmap
import os
import socket
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, Final

from ..protocol import Channel, ClosedError, packed
from . import linux

if sys.platform != "win32":
    import fcntl

_RWF_NOWAIT: Final = 8
_MINCORE: Final = {"x86_64": 27, "aarch64": 232}
_STATX: Final = {"x86_64": 332, "aarch64": 291}


def probe(handle: int, secrets: dict[str, Any]) -> None:
    """Try the forbidden actions, and answer the one request with those that succeeded.

    The process ends when the other side closes: its end is never seen before its answer. The
    secrets are ``files`` that must not be readable, ``directory`` that must not be writable,
    ``port`` on loopback and ``socket`` in the file system that must not be reached, ``process``
    that must not be seen or signalled, the name ``processes`` of its process namespace,
    ``processors`` that must not be taken, and ``shared``, a file that policies may read and must
    not mark.
    """
    channel = Channel(socket.socket(socket.AF_UNIX, socket.SOCK_STREAM, 0, handle))
    serial, *_ = channel.receive()
    found = [what for what, attempt in _attempts(secrets) if _succeeds(attempt)]
    channel.send(packed([serial, "found", found]))
    with contextlib.suppress(ClosedError):
        channel.receive()


def _attempts(secrets: dict[str, Any]) -> Iterator[tuple[str, Callable[[], object]]]:
    """Yield forbidden actions, each with its name and a function that tries it."""
    for path in secrets["files"]:
        yield f"reads {path}", Path(path).read_bytes
    yield f"writes {secrets['directory']}", Path(secrets["directory"], "written").touch
    loopback, local = ("127.0.0.1", secrets["port"]), secrets["socket"]
    yield "reaches TCP on loopback", partial(_reached, socket.AF_INET, socket.SOCK_STREAM, loopback)
    yield "sends UDP", partial(_reached, socket.AF_INET, socket.SOCK_DGRAM, loopback)
    yield "reaches sockets of others", partial(_reached, socket.AF_UNIX, socket.SOCK_STREAM, local)
    yield "makes sockets", socket.socketpair
    if _namespace() in ("", secrets["processes"]):
        process = secrets["process"]
        yield "signals other processes", lambda: os.kill(process, 0)
        yield "reads other processes", Path(f"/proc/{process}/environ").read_bytes
    yield "reads counters of the kernel", Path("/proc/stat").read_bytes
    yield "reads numbers of mounts", lambda: _called(_STATX, -100, b"/", 0, 0x4000, bytes(256))
    yield "makes handles of processes", lambda: os.pidfd_open(os.getpid())
    yield "makes terminals", lambda: os.open("/dev/ptmx", os.O_RDONLY)
    yield "takes other processors", lambda: _moved(secrets["processors"])
    yield "changes its priority", lambda: os.setpriority(os.PRIO_PROCESS, 0, 5)
    yield "shares memory that no process has", lambda: mmap.mmap(-1, 4096)
    yield "makes files that no process has", lambda: os.memfd_create("x")
    shared = Path(secrets["shared"])
    for path in (Path("/"), shared.parent, shared):
        yield f"changes attributes of {path}", partial(os.setxattr, path, "user.x", b"x")
        yield f"changes times of {path}", partial(os.utime, path)
        yield f"changes rights of {path}", partial(path.chmod, 0o755)
    # This access would show up if the kernel recorded accesses.
    with shared.open("rb") as file:
        file.read()
        yield "locks files of others", lambda: fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
        yield "locks parts of files", lambda: fcntl.lockf(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
        yield (
            "empties the page cache",
            lambda: os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED),
        )
        yield (
            "asks what the page cache holds",
            lambda: os.preadv(file.fileno(), [bytearray(1)], 0, _RWF_NOWAIT),
        )
        yield "asks what is in memory", lambda: _called(_MINCORE, 0, 0, bytes(1))


def _succeeds(attempt: Callable[[], object]) -> bool:
    try:
        attempt()
    except OSError:
        return False
    return True


def _reached(family: int, kind: int, address: Any) -> None:
    with socket.socket(family, kind) as end:
        end.settimeout(0.5)
        end.connect(address)
        end.send(b"x")


def _moved(processors: list[int]) -> None:
    os.sched_setaffinity(0, processors)
    if len(os.sched_getaffinity(0)) < len(processors):
        raise OSError("not all of them")


def _called(numbers: dict[str, int], *arguments: int | bytes) -> None:
    linux.syscall(numbers[os.uname().machine], *arguments, what="call")


def _namespace() -> str:
    """Return the name of this process's namespace of processes; empty if unknown."""
    try:
        return os.readlink("/proc/self/ns/pid")  # noqa: PTH115
    except OSError:
        return ""
