"""The probe: a policy that tries all that a sandbox must prevent, and prints what succeeded."""

import json
import mmap
import os
import platform
import socket
import threading
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, Final

from colift.agents.agent import Action, Observation
from colift.agents.sandbox.guest import linux
from colift.agents.sandbox.guest.filters import NUMBERS
from colift.agents.sandbox.protocol import SECRETS

_RWF_NOWAIT: Final = 8
_NUMBERS: Final = {
    **NUMBERS,
    "mincore": {"x86_64": 27, "aarch64": 232}.get(platform.machine(), -1),
}
_WAKE: Final = 1
_PROCESSOR_TIME: Final = 2


class Probe:
    """Tries what is forbidden while it is loaded, and in a lift, and prints what succeeds."""

    def __init__(self) -> None:
        self._seen = False

    def reset(self, seed: int) -> None:
        """Try what no policy may do."""
        secrets = json.loads(Path(SECRETS).read_text())
        with Path(secrets["shared"]).open("rb") as file:
            self._mapped = mmap.mmap(file.fileno(), 0, mmap.MAP_PRIVATE, mmap.PROT_READ)
        _try(_attempts(secrets))

    def act(self, observation: Observation) -> Action:
        """Try what no policy may do that has seen a lift."""
        _try(_attempts_inside())
        if self._seen:
            print("knows of an earlier lift")
        self._seen = True
        return observation[:1]


def _try(attempts: Iterator[tuple[str, Callable[[], object]]]) -> None:
    for what, attempt in attempts:
        if _succeeds(attempt):
            print(what)


def _attempts_inside() -> Iterator[tuple[str, Callable[[], object]]]:
    """Yield what no policy may do in a lift."""
    import resource  # Windows, where this file is only read, has none.

    yield "opens files in a lift", lambda: os.open("/dev/null", os.O_RDONLY)
    yield "asks for names in a lift", lambda: _called("access", b"/", 0)
    yield "reads /proc in a lift", Path("/proc/self/statm").read_bytes
    yield "makes pipes in a lift", os.pipe
    yield "makes sockets in a lift", socket.socketpair
    yield "makes processes in a lift", _forked
    yield "makes threads in a lift", threading.Thread(target=int).start
    yield "signals in a lift", lambda: os.kill(os.getpid(), 0)
    yield "reads counters in a lift", lambda: resource.getrusage(resource.RUSAGE_SELF)
    yield "writes elsewhere in a lift", lambda: os.write(0, b"x")
    yield "shares memory in a lift", lambda: mmap.mmap(-1, 4096)
    yield "makes code in a lift", lambda: mmap.mmap(-1, 4096, 34, mmap.PROT_READ | mmap.PROT_EXEC)
    yield "wakes others in a lift", lambda: _called("futex", bytes(8), _WAKE, 1, 0, 0, 0)
    yield (
        "reads the processor time of others in a lift",
        lambda: time.clock_gettime(~1 << 3 | _PROCESSOR_TIME),
    )
    yield "changes its limits in a lift", lambda: resource.getrlimit(resource.RLIMIT_CORE)


def _attempts(secrets: dict[str, Any]) -> Iterator[tuple[str, Callable[[], object]]]:
    """Yield what no policy may do, each with its name and a function that tries it."""
    import fcntl  # Windows, where this file is only read, has neither.
    import resource  # noqa: F401 - a lift can import nothing

    for path in secrets["files"]:
        yield f"reads {path}", Path(path).read_bytes
    yield f"writes {secrets['directory']}", Path(secrets["directory"], "written").touch
    loopback, local = ("127.0.0.1", secrets["port"]), secrets["socket"]
    yield "reaches TCP on loopback", partial(_reached, socket.AF_INET, socket.SOCK_STREAM, loopback)
    yield "sends UDP", partial(_reached, socket.AF_INET, socket.SOCK_DGRAM, loopback)
    yield "reaches sockets of others", partial(_reached, socket.AF_UNIX, socket.SOCK_STREAM, local)
    yield "makes sockets", socket.socketpair
    yield "makes pipes", os.pipe
    yield "makes processes", _forked
    yield "installs filters", lambda: _called("seccomp", 1, 0, bytes(16))
    if _namespace() in ("", secrets["processes"]):
        process = secrets["process"]
        yield "signals other processes", lambda: os.kill(process, 0)
        yield "reads other processes", Path(f"/proc/{process}/environ").read_bytes
    yield "reads counters of the kernel", Path("/proc/stat").read_bytes
    yield "reads numbers of mounts", lambda: _called("statx", -100, b"/", 0, 0x4000, bytes(256))
    yield "makes handles of processes", lambda: os.pidfd_open(os.getpid())
    yield "makes terminals", lambda: os.open("/dev/ptmx", os.O_RDONLY)
    yield "takes other processors", lambda: _moved(secrets["processors"])
    yield "changes its priority", lambda: os.setpriority(os.PRIO_PROCESS, 0, 5)
    yield "shares memory", lambda: mmap.mmap(-1, 4096)
    yield "makes files that no process has", lambda: os.memfd_create("x")
    shared = Path(secrets["shared"])
    for path in (Path("/"), shared.parent, shared):
        yield f"changes attributes of {path}", partial(os.setxattr, path, "user.x", b"x")
        yield f"changes times of {path}", partial(os.utime, path)
        yield f"changes rights of {path}", partial(path.chmod, 0o755)
    # This access would show up if the kernel recorded accesses.
    with shared.open("rb") as file:
        file.read(1)
        yield "shares memory of files", lambda: mmap.mmap(file.fileno(), 1, access=mmap.ACCESS_READ)
        yield "locks files of others", lambda: fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
        yield "locks parts of files", lambda: fcntl.lockf(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
        yield (
            "asks what the page cache holds",
            lambda: os.preadv(file.fileno(), [bytearray(1)], 0, _RWF_NOWAIT),
        )
        yield (
            "empties the page cache",
            lambda: os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED),
        )
        yield "asks what is in memory", lambda: _called("mincore", 0, 0, bytes(1))


def _succeeds(attempt: Callable[[], object]) -> bool:
    try:
        attempt()
    except (OSError, RuntimeError):  # The latter of threads.
        return False
    return True


def _forked() -> None:
    if os.fork() == 0:
        os._exit(0)


def _reached(family: int, kind: int, address: Any) -> None:
    with socket.socket(family, kind) as end:
        end.settimeout(0.5)
        end.connect(address)
        end.send(b"x")


def _moved(processors: list[int]) -> None:
    os.sched_setaffinity(0, processors)
    if len(os.sched_getaffinity(0)) < len(processors):
        raise OSError("not all of them")


def _called(name: str, *arguments: int | bytes) -> None:
    linux.syscall(_NUMBERS[name], *arguments, what=name)


def _namespace() -> str:
    """Return the name of this process's namespace of processes; empty if unknown."""
    try:
        return os.readlink("/proc/self/ns/pid")  # noqa: PTH115
    except OSError:
        return ""
