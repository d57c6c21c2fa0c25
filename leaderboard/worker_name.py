"""What a worker is called: so that another on the same machine sees at once that it is gone."""

import hashlib
import os
import socket
from pathlib import Path


def this_worker() -> str:
    """Return the name of this process: host, machine, process id, when it was started."""
    pid = os.getpid()
    return f"{socket.gethostname()}/{_machine()}/{pid}/{_started(pid)}"


def is_gone(worker: str) -> bool:
    """Return whether a worker was a process of this machine and is none any more."""
    parts = worker.split("/")
    if len(parts) != 4 or parts[1] != _machine() or not parts[2].isdecimal():
        return False  # Elsewhere: only its silence tells.
    return _started(int(parts[2])) != parts[3]


def _machine() -> str:
    """Return what the processes share whose ids mean the same to this one."""
    boot = Path("/proc/sys/kernel/random/boot_id").read_text().strip()
    space = Path("/proc/self/ns/pid").readlink()
    return hashlib.sha256(f"{boot} {space}".encode()).hexdigest()[:12]


def _started(pid: int) -> str | None:
    """Return when a process was started, in ticks of this boot; None if it runs no more."""
    try:
        told = Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return None
    state, *fields = told.rpartition(")")[2].split()
    return None if state in "ZX" else fields[18]
