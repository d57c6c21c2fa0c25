"""Jobs as the database stores them, and the names of their workers."""

import hashlib
import os
import socket
from datetime import datetime
from pathlib import Path
from typing import Any, Final

from colift.leaderboard.records.job import Job
from colift.leaderboard.records.season import BoardEntry
from colift.leaderboard.storage.store import Store

REASON: Final = 2000
"""Maximum length of a reason [characters]."""


def read_job(found: Any, store: Store) -> Job:
    """Return the job of a row of the table, with its log, for publication."""
    own = {name: value for name, value in found.items() if name in Job.__dataclass_fields__}
    texts = {"reason": found["reason"], "log": store.log(found["id"])}
    public = {name: text and store.placeless(text) for name, text in texts.items()}
    return Job(**{**own, **public})


def job_outcome(entry: BoardEntry, ended_at: datetime) -> dict[str, Any]:
    """Return the changes of a job when its entry was made."""
    content: dict[str, Any] = {"state": "done", "reason": None, "ended_at": ended_at}
    if entry.row is None:
        content |= {"state": "failed", "reason": storable_reason(entry.refusal or "refused")}
    return content


def storable_reason(reason: str) -> str:
    """Return a reason that any database can store: no NUL, no surrogates, not too long."""
    text = reason.replace("\0", "").encode(errors="replace").decode()
    return text if len(text) <= REASON else f"{text[: REASON - 3]}..."


def this_worker() -> str:
    """Return the name of this process: host, machine, process id and start time."""
    pid = os.getpid()
    return f"{socket.gethostname()}/{_machine()}/{pid}/{_started(pid)}"


def is_gone(worker: str) -> bool:
    """Return whether a worker was a process of this machine that has ended."""
    parts = worker.split("/")
    if len(parts) != 4 or parts[1] != _machine() or not parts[2].isdecimal():
        return False  # On another machine: only its lease counts.
    return _started(int(parts[2])) != parts[3]


def _machine() -> str:
    """Return a text that processes share if their ids are of the same namespace and boot."""
    boot = Path("/proc/sys/kernel/random/boot_id").read_text().strip()
    space = Path("/proc/self/ns/pid").readlink()
    return hashlib.sha256(f"{boot} {space}".encode()).hexdigest()[:12]


def _started(pid: int) -> str | None:
    """Return the start time of a process in ticks of this boot; None if it has ended."""
    try:
        stat = Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return None
    state, *fields = stat.rpartition(")")[2].split()
    return None if state in "ZX" else fields[18]
