"""A sandbox: a fork server on a rung of the ladder, and the cells that it starts."""

import contextlib
import json
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import weakref
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from ..errors import EvaluatorFault, PolicyError
from .connection import Connection
from .forkserver import EPISODE, PRELOAD, PROBE, SETTINGS
from .launch import BUBBLEWRAP, command, settings
from .limits import REASON, Limits
from .output import Output, clean
from .view import environment, view

READY_SECONDS: Final = 60.0
"""How long a fork server may take to start [s]."""

_CLOSE_SECONDS: Final = 5.0


@dataclass(frozen=True, kw_only=True)
class Work:
    """What a cell is for."""

    place: str
    """Where the policy's class is: ``module:Class`` or ``file.py:Class``."""
    parameters: str = ""
    """What is set of it."""
    size: int = 1
    """How many numbers its action is."""

    def order(self, kind: bytes) -> bytes:
        """Return the order for a cell."""
        return kind + json.dumps([self.place, self.parameters, self.size]).encode()


class Sandbox:
    """A running fork server; use it from one thread.

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
        self.rung = rung
        self._seen = seen
        self._limits = limits
        self._inner: Connection | None = None
        self._work: Work | None = None
        self.imported = ""
        self._start()

    def _start(self) -> None:
        seen = view(self._seen)
        self._scratch = tempfile.mkdtemp(prefix="colift-")
        self._orders, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        words = command(self.rung, seen, theirs.fileno(), superuser=os.geteuid() == 0)
        with tempfile.TemporaryFile() as errors, contextlib.closing(theirs):
            try:
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
                self._orders.close()
                shutil.rmtree(self._scratch, ignore_errors=True)
                raise EvaluatorFault(f"the {self.rung} sandbox does not start: {error}") from error
            theirs.close()
            self._end = weakref.finalize(
                self, _end, os.getpid(), self._process, self._orders, self._scratch
            )
            try:
                told = self._introduce(settings(self.rung, seen))
            except (OSError, ValueError) as error:
                self.close()
                errors.seek(0)
                said = clean(errors.read().decode(errors="replace")).strip() or str(error)
                raise EvaluatorFault(
                    f"the {self.rung} sandbox does not start: {said[-REASON:]}"
                ) from error
        self.namespaces: str = told["namespaces"]

    def _introduce(self, rung: dict[str, Any]) -> dict[str, Any]:
        """Tell the fork server what it is for, and return what it says of itself."""
        content = rung | {
            "folder": str(self._seen) if self._seen and self._seen.is_dir() else "",
            "limits": self._limits.plain(),
            "scratch": self._scratch,
        }
        self._orders.settimeout(READY_SECONDS)
        self._orders.send(json.dumps(content).encode())
        answer = self._orders.recv(SETTINGS)
        if not answer:
            raise OSError("it has ended")
        told: dict[str, Any] = json.loads(answer)
        return told

    @property
    def alive(self) -> bool:
        """Whether it can start cells."""
        return self._end.alive and self._process.poll() is None

    def episode(self, work: Work) -> Connection:
        """Return the connection to a fresh cell for a policy.

        Raises
        ------
        EvaluatorFault
            If there is none to be had.
        """
        if not self.alive or (self.rung == BUBBLEWRAP and not self.namespaces):
            # Without namespaces inside, only a new bubblewrap has a fresh /tmp.
            self.close()
            self._start()
        return self._cell(work.order(EPISODE))

    def probe(self, secrets: dict[str, Any]) -> Connection:
        """Return the connection to a cell that tries what no policy may."""
        return self._cell(PROBE + json.dumps(secrets).encode())

    def preloaded(self, work: Work) -> Connection:
        """Return the connection to a process forked from one that has imported the policy.

        Raises
        ------
        PolicyError
            If the policy cannot be imported.
        EvaluatorFault
            If there is no cell to be had.
        """
        if self._inner is None or self._inner.ended or self._work != work:
            self._import(work)
        assert self._inner is not None
        data, theirs = socket.socketpair()
        reading, writing = os.pipe()
        try:
            socket.send_fds(self._inner.data, [b"e"], [theirs.fileno(), writing])
        except OSError:
            raise self._inner.lost() from None
        finally:
            theirs.close()
            os.close(writing)
            connection = self._inner.beside(data, Output(reading))
        return connection

    def _import(self, work: Work) -> None:
        self._end_inner()
        self._work = work
        if not self.alive:
            self.close()
            self._start()
        self._inner = self._cell(work.order(PRELOAD), socket.SOCK_SEQPACKET)
        kind, *reason = self._inner.request(["load"], self._limits.start_seconds)
        self.imported = self._inner.output.text
        if kind != "loaded":
            self._end_inner()
            raise PolicyError(clean(str(*reason[:1]))[:REASON])

    def _end_inner(self) -> None:
        if self._inner is not None:
            self._inner.close()
            self._inner = None

    def _cell(self, order: bytes, kind: int = socket.SOCK_STREAM) -> Connection:
        """Return the connection to a new cell."""
        data, its_data = socket.socketpair(socket.AF_UNIX, kind)
        status, its_status = socket.socketpair()
        reading, writing = os.pipe()
        theirs = [its_data.fileno(), writing, its_status.fileno()]
        connection = Connection(
            data=data,
            output=Output(reading),
            status=status,
            limits=self._limits,
            sure=bool(self.namespaces),
        )
        try:
            socket.send_fds(self._orders, [order], theirs)
        except OSError as error:
            connection.close()
            raise EvaluatorFault(f"the sandbox has ended: {error}") from error
        finally:
            its_data.close()
            its_status.close()
            os.close(writing)
        return connection

    def close(self) -> None:
        """End all of its processes."""
        self._end_inner()
        self._end()


def _end(owner: int, process: subprocess.Popen[bytes], orders: socket.socket, scratch: str) -> None:
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
    shutil.rmtree(scratch, ignore_errors=True)
