"""What a sandbox keeps from a policy, found out by trying, from inside a cell."""

import contextlib
import os
import socket
from pathlib import Path
from typing import Any

from .wire import packed


def look(handle: int, secrets: dict[str, Any]) -> None:
    """Try what no policy may, and tell on a connection what was possible.

    Parameters
    ----------
    handle
        File descriptor of the connection.
    secrets
        ``files`` that must not be readable, ``directory`` that must not be writable, ``port`` on
        loopback that must not be reached, ``process`` that must not be seen or signalled, and the
        name ``processes`` of its process namespace.
    """
    found = [f"reads {path}" for path in secrets["files"] if _reads(path)]
    found += [f"writes {secrets['directory']}"] if _writes(Path(secrets["directory"])) else []
    found += ["reaches TCP on loopback"] if _connects(secrets["port"]) else []
    found += ["sends UDP"] if _sends(secrets["port"]) else []
    if _namespace() in ("", secrets["processes"]):
        process = secrets["process"]
        found += ["signals other processes"] if _signals(process) else []
        found += ["reads other processes"] if _reads(f"/proc/{process}/environ") else []
    with socket.socket(fileno=handle) as end:
        end.sendall(packed([1, "found", found]))


def _reads(path: str) -> bool:
    try:
        return bool(Path(path).read_bytes()) or True
    except OSError:
        return False


def _writes(directory: Path) -> bool:
    try:
        (directory / "written").write_text("x")
    except OSError:
        return False
    return True


def _connects(port: int) -> bool:
    with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), 0.5):
        return True
    return False


def _sends(port: int) -> bool:
    with contextlib.suppress(OSError), socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as end:
        end.sendto(b"x", ("127.0.0.1", port))
        return True
    return False


def _signals(process: int) -> bool:
    try:
        os.kill(process, 0)
    except OSError:
        return False
    return True


def _namespace() -> str:
    """Return the name of the own process namespace; empty if it cannot be told."""
    try:
        return os.readlink("/proc/self/ns/pid")  # noqa: PTH115
    except OSError:
        return ""
