"""The isolation levels, strongest first, and which of them work here."""

import contextlib
import ctypes
import json
import logging
import math
import mmap
import os
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from colift.agents.sandbox.host.agent import allowed, remote_agent
from colift.agents.sandbox.host.process import BUBBLEWRAP, LANDLOCK, LIMITS
from colift.agents.sandbox.host.refusals import in_words
from colift.agents.sandbox.host.sandbox import Load, Sandbox
from colift.agents.sandbox.protocol import AGENTS, SECRETS, Assignment, Limits
from colift.base.errors import EvaluatorFault, InputError, PolicyError

log: Final = logging.getLogger("colift.sandbox")
"""The reasons in the system's words, as information."""

LEVELS: Final = {
    BUBBLEWRAP: "all of landlock, within the walls of the program bubblewrap",
    LANDLOCK: "the policy has files, processes, a network and users of its own, and may make only "
    "the system calls of a short list",
    LIMITS: "no walls: memory and time are limited, and files and system calls where the kernel "
    "can do that",
}
"""The levels, each in words."""

VERIFIABLE: Final = frozenset({BUBBLEWRAP, LANDLOCK})
"""Levels whose results can be called verified: on the others a policy can cheat."""

TRIES: Final = 3
"""Attempts after which a level counts as not working."""

_PAUSE_SECONDS: Final = 0.2
"""Pause before the second attempt [s]; before the third it is twice as long."""

_KEPT_SECONDS: Final = 60.0
"""Time after which a level that failed is tried again [s]."""

_SECONDS: Final = 60.0
"""Time limit of the probe, for a busy machine [s]."""

_SHARED: Final = 1 << 20
"""Size of the file that the probe shares with others: it touches only the beginning [bytes]."""

_SHORT: Final = "/tmp"
"""Folder of the probe's socket, whose path has at most 107 characters wherever others lie."""

_PROBE: Final = Assignment("colift.agents.sandbox.guest.probe:Probe")

_SECRETS: Final = ("humans/__init__.py", "../benchmark/__init__.py")
"""Files of colift, beside the agents, that no policy may read."""

_found: Final[dict[str, tuple[float, str | None]]] = {}
"""Findings by level: expiry (monotonic clock), and the reason if the level does not work."""


@dataclass(frozen=True, kw_only=True)
class Choice:
    """A level, and the stronger ones that do not work here."""

    level: str
    passed: Mapping[str, str]
    """The stronger levels, each with the reason why it does not work."""

    def __str__(self) -> str:
        """Return level and reasons on one line."""
        return "; ".join([f"isolation {self.level}", *_faults(self.passed)])


def _faults(reasons: Mapping[str, str]) -> list[str]:
    """Return each reason once, with the levels that it stops."""
    levels: dict[str, list[str]] = {}
    for name, reason in reasons.items():
        levels.setdefault(reason, []).append(name)
    return [
        "; nor does ".join((f"{first} does not work here: {reason}", *others))
        for reason, (first, *others) in levels.items()
    ]


def working_levels() -> tuple[str, ...]:
    """Return the levels that work here, strongest first."""
    return tuple(name for name in LEVELS if fault(name) is None)


def choose(*, verifiable: bool = False) -> Choice:
    """Return the strongest level that works here, with the reasons why stronger ones do not.

    With ``verifiable`` only the levels of :data:`VERIFIABLE` are considered. Raise EvaluatorFault
    with all reasons if none works.
    """
    passed: dict[str, str] = {}
    for name in LEVELS:
        if name in VERIFIABLE or not verifiable:
            reason = fault(name)
            if reason is None:
                return Choice(level=name, passed=passed)
            passed[name] = reason
    reasons = "; ".join(_faults(passed))
    raise EvaluatorFault(f"no sandbox that is strong enough works here: {reasons}")


def strongest() -> str:
    """Return the level of :func:`choose`."""
    return choose().level


def check_level(name: str) -> None:
    """Raise InputError if there is no such level."""
    if name not in LEVELS:
        raise InputError(f"unknown isolation {name!r}; known: {', '.join(LEVELS)}")


def fault(name: str) -> str | None:
    """Return the reason why a level does not work here, None if it does: a probe tries it.

    A failure counts after :data:`TRIES` attempts, and is remembered for a minute. Raise InputError
    if there is no such level.
    """
    check_level(name)
    until, reason = _found.get(name, (-math.inf, None))
    if time.monotonic() >= until:
        reason = _tried(name)
        until = math.inf if reason is None else time.monotonic() + _KEPT_SECONDS
        _found[name] = until, reason
    return reason


def forget() -> None:
    """Forget all findings: every level is tried again when it is needed next."""
    _found.clear()


def _tried(name: str) -> str | None:
    """Return the reason why a level fails in all attempts; None as soon as one succeeds."""
    reason = None
    for number in range(TRIES):
        if number:
            time.sleep(number * _PAUSE_SECONDS)
        try:
            found = holes(name)
        except (EvaluatorFault, PolicyError) as error:
            log.info("%s does not work here: %s", name, error)
            reason = in_words(str(error))
        else:
            reason = "; ".join(found) if name in VERIFIABLE else None
        if not reason:
            return None
    return reason


def holes(name: str) -> list[str]:
    """Return the forbidden actions that succeed at a level: a probe tries them.

    Raise EvaluatorFault or PolicyError if the level does not work here.
    """
    with (
        tempfile.TemporaryDirectory(prefix="colift-probe-") as directory,
        tempfile.TemporaryDirectory(prefix="colift-probe-") as seen,
        tempfile.TemporaryDirectory(prefix="colift-probe-", dir=_SHORT) as near,
        socket.create_server(("127.0.0.1", 0)) as listening,
        socket.socket(socket.AF_UNIX) as local,
        subprocess.Popen(
            [sys.executable, "-S", "-c", "import sys; sys.stdin.read()"], stdin=subprocess.PIPE
        ) as other,
    ):
        secret, shared = Path(directory, "secret"), Path(seen, "shared")
        secret.write_text("colift")
        with shared.open("wb") as file:
            file.write(bytes(_SHARED))
            os.fsync(file.fileno())
            os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)
        os.utime(shared, (1, 2))  # Older than written: the next access is recorded.
        local.bind(str(Path(near, "socket")))
        local.listen()
        files = (secret, "/etc/shadow", *(AGENTS / each for each in _SECRETS))
        secrets = {
            "files": [str(each) for each in files],
            "directory": directory,
            "port": listening.getsockname()[1],
            "socket": local.getsockname(),
            "process": other.pid,
            "processes": os.readlink("/proc/self/ns/pid"),  # noqa: PTH115
            "processors": sorted(allowed()),
            "shared": str(shared),
        }
        Path(seen, SECRETS).write_text(json.dumps(secrets))
        limits = Limits(start_seconds=_SECONDS, step_periods=600.0)
        sandbox = Sandbox(name, Path(seen), limits)
        try:
            with contextlib.closing(remote_agent(sandbox, Load(_PROBE, ""), limits)) as agent:
                found = []
                for _ in range(2):
                    agent.reset(0)
                    found += [] if _in_memory(shared) else ["finds pages that are not in memory"]
                    agent.act(np.zeros(1))
                    found += agent.printed.splitlines()
        finally:
            sandbox.close()
            other.kill()
        if shared.stat().st_atime != 1:
            found.append("leaves the time of its last access on files")
    return list(dict.fromkeys(found))


def _in_memory(path: Path) -> bool:
    """Return whether the last page of a file is in memory; its time of access stays as it is."""
    handle = os.open(path, os.O_RDONLY | os.O_NOATIME)
    try:
        with mmap.mmap(handle, 0, access=mmap.ACCESS_COPY) as pages:
            found = (ctypes.c_ubyte * math.ceil(len(pages) / mmap.PAGESIZE))()
            start = ctypes.c_void_p(ctypes.addressof(ctypes.c_char.from_buffer(pages)))
            # Not preadv with RWF_NOWAIT: the file systems of containers do not have it.
            if ctypes.CDLL(None, use_errno=True).mincore(start, ctypes.c_size_t(len(pages)), found):
                raise OSError(ctypes.get_errno(), "mincore")
    finally:
        os.close(handle)
    return bool(found[-1] & 1)
