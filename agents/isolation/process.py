"""A fork server as a process: started, introduced to its rung, ended."""

import contextlib
import json
import os
import signal
import socket
import subprocess
import tempfile
import weakref
from pathlib import Path
from typing import Any, Final

from ..errors import EvaluatorFault
from .forkserver import SETTINGS
from .launch import command, settings
from .limits import REASON, Limits
from .output import clean
from .view import environment, view

READY_SECONDS: Final = 60.0
"""How long a fork server may take to start [s]."""

_CLOSE_SECONDS: Final = 5.0


class ForkServer:
    """A running fork server; it ends when this object does, or its owner.

    Parameters
    ----------
    rung
        Name of the rung.
    seen
        File or folder that policies see beside Python; they start in it if it is a folder.
    limits
        What an episode may use up.

    Raises
    ------
    EvaluatorFault
        If it does not start.
    """

    def __init__(self, rung: str, seen: Path | None, limits: Limits) -> None:
        visible = view(seen)
        self.orders, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        """Where it takes orders."""
        with tempfile.TemporaryFile() as errors, contextlib.closing(theirs):
            try:
                words = command(rung, visible, theirs.fileno(), superuser=os.geteuid() == 0)
                self._process = subprocess.Popen(
                    words,
                    stdin=subprocess.DEVNULL,
                    stdout=errors,
                    stderr=errors,
                    pass_fds=[theirs.fileno()],
                    env=environment(),
                    cwd="/",
                    start_new_session=True,
                )
            except OSError as error:
                self.orders.close()
                raise EvaluatorFault(f"the {rung} sandbox does not start: {error}") from error
            theirs.close()
            self.close = weakref.finalize(self, _end, os.getpid(), self._process, self.orders)
            """End all of its processes."""
            own = {
                "folder": str(seen) if seen and seen.is_dir() else "",
                "limits": limits.plain(),
            }
            try:
                told = self._introduce(settings(rung, visible) | own)
            except (OSError, ValueError) as error:
                self.close()
                errors.seek(0)
                said = clean(errors.read().decode(errors="replace")).strip() or str(error)
                raise EvaluatorFault(
                    f"the {rung} sandbox does not start: {said[-REASON:]}"
                ) from error
        self.namespaces: str = told["namespaces"]
        """Which namespaces its cells have; see :class:`.walls.Walls`."""

    def _introduce(self, content: dict[str, Any]) -> dict[str, Any]:
        """Tell the fork server what it is for, and return what it says of itself."""
        self.orders.settimeout(READY_SECONDS)
        self.orders.send(json.dumps(content).encode())
        answer = self.orders.recv(SETTINGS)
        if not answer:
            raise OSError("it has ended")
        told: dict[str, Any] = json.loads(answer)
        return told

    @property
    def alive(self) -> bool:
        """Whether it can start cells."""
        return self.close.alive and self._process.poll() is None


def _end(owner: int, process: subprocess.Popen[bytes], orders: socket.socket) -> None:
    """End a fork server; in a fork of its owner, only let go of it."""
    orders.close()
    if os.getpid() != owner:
        process.returncode = 0
        return
    try:
        process.wait(_CLOSE_SECONDS)
    except subprocess.TimeoutExpired:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
