"""The process of a fork server at an isolation level: its command, its start, its end."""

import contextlib
import json
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import weakref
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any, Final

from ...errors import EvaluatorFault
from ..protocol import AGENTS, MIB, ORDER, REASON, Limits
from .connection import clean
from .control_group import ControlGroup
from .view import View, environment, view

BUBBLEWRAP: Final = "bubblewrap"
LANDLOCK: Final = "landlock"
LIMITS: Final = "limits"

READY_SECONDS: Final = 60.0
"""How long a fork server may take to start [s]."""

HEADROOM: Final = 256 * MIB
"""Memory of a control group beyond the policy's: the fork server with what it has imported, and the
processes that watch [bytes]."""

_CLOSE_SECONDS: Final = 5.0

_BOOTSTRAP: Final = """
import sys
from importlib.util import module_from_spec, spec_from_file_location
from types import ModuleType
agents, handle, *packages = sys.argv[1:]
sys.path += packages
colift = sys.modules["colift"] = ModuleType("colift")
colift.__path__ = []
spec = spec_from_file_location(
    "colift.agents", agents + "/__init__.py", submodule_search_locations=[agents]
)
colift.agents = sys.modules["colift.agents"] = module_from_spec(spec)
spec.loader.exec_module(colift.agents)
from colift.agents.sandbox.guest.forkserver import main
main(int(handle))
"""
"""Makes a ``colift`` that has nothing but ``colift.agents``, whatever is beside it."""

_PRIVILEGES: Final = [
    "SYS_ADMIN",
    "SETUID",
    "SETGID",
    "SETPCAP",
    "SETFCAP",
    "KILL",
    "DAC_READ_SEARCH",
]
"""What the superuser's fork server needs to make namespaces."""


class ForkServer:
    """A running fork server; it ends when this object does, or its owner.

    It serves at an isolation level; policies see a file or a folder beside Python, in which they
    start, and may use up the limits in an episode. Raise EvaluatorFault if it does not start.
    """

    def __init__(self, isolation: str, seen: Path | None, limits: Limits) -> None:
        visible = view(seen)
        group = None
        with contextlib.suppress(OSError):  # There are none to be had everywhere.
            group = ControlGroup(limits.memory + HEADROOM)
        self.orders, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        """Where it takes orders."""
        with tempfile.TemporaryFile() as errors, contextlib.closing(theirs):
            try:
                words = command(isolation, visible, theirs.fileno(), superuser=os.geteuid() == 0)
                self._process = subprocess.Popen(
                    group.entering(words) if group else words,
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
                if group:
                    group.remove()
                raise EvaluatorFault(f"the {isolation} sandbox does not start: {error}") from error
            theirs.close()
            self.close = weakref.finalize(
                self, _end, os.getpid(), self._process, self.orders, group
            )
            """End all of its processes."""
            try:
                settings = _settings(isolation, visible, seen, limits)
                self.namespaces = self._introduce(settings)
                """Which an episode has: made by ``root``, by the ``user``, or none (empty)."""
            except (OSError, ValueError) as error:
                self.close()
                errors.seek(0)
                said = clean(errors.read().decode(errors="replace")).strip() or str(error)
                raise EvaluatorFault(
                    f"the {isolation} sandbox does not start: {said[-REASON:]}"
                ) from error

    def _introduce(self, content: dict[str, Any]) -> str:
        """Tell the fork server what it is for, and return which namespaces it makes."""
        self.orders.settimeout(READY_SECONDS)
        self.orders.send(json.dumps(content).encode())
        answer = self.orders.recv(ORDER)
        if not answer:
            raise OSError("it has ended")
        return str(json.loads(answer))

    @property
    def alive(self) -> bool:
        """Whether it can start episodes."""
        return self.close.alive and self._process.poll() is None


def _end(
    owner: int, process: subprocess.Popen[bytes], orders: socket.socket, group: ControlGroup | None
) -> None:
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
    if group:
        group.remove()


def _settings(isolation: str, visible: View, seen: Path | None, limits: Limits) -> dict[str, Any]:
    """Return what the fork server must know: :class:`.Restrictions` in JSON."""
    covered = isolation != LIMITS
    shown = visible.outermost() if covered else visible.visible()
    return {
        "namespaces": covered,
        "landlock": isolation == LANDLOCK,
        "readable": [str(path) for path in shown],
        "hidden": [str(path) for path in visible.hidden] if covered else [],
        "folder": str(seen) if seen and seen.is_dir() else "",
        "limits": asdict(limits),
    }


def command(isolation: str, visible: View, handle: int, *, superuser: bool) -> list[str]:
    """Return the command that starts a fork server.

    It sees what is visible and takes its orders at the file descriptor ``handle``; ``superuser`` is
    whether the superuser will start it. FileNotFoundError if a program is not installed.
    """
    packages = [str(each) for each in visible.packages]
    options = ["-s", "-P", "-S", "-u", "-c", _BOOTSTRAP]
    python = [str(visible.python), *options, str(AGENTS), str(handle), *packages]
    return [*_bubblewrap(visible, superuser), *python] if isolation == BUBBLEWRAP else python


def _bubblewrap(visible: View, superuser: bool) -> Iterator[str]:
    program = shutil.which("bwrap")
    if program is None:
        raise FileNotFoundError("bwrap is not installed")
    yield program
    # The superuser's fork server keeps what it needs to make namespaces of processes that then
    # are nobody outside too, which a user namespace of bubblewrap's own would not allow.
    yield from ("--unshare-pid", "--unshare-net", "--unshare-ipc", "--unshare-uts")
    if superuser:
        yield from ("--cap-drop", "ALL")
        for name in _PRIVILEGES:
            yield from ("--cap-add", f"CAP_{name}")
    else:
        yield from ("--unshare-user", "--unshare-cgroup-try")
    yield from ("--die-with-parent", "--new-session", "--clearenv")
    for name, value in environment().items():
        yield from ("--setenv", name, value)
    yield from ("--tmpfs", "/tmp", "--proc", "/proc", "--dev", "/dev")
    for path in visible.outermost():
        link = path.is_symlink()
        yield from ("--symlink", str(path.readlink())) if link else ("--ro-bind", str(path))
        yield str(path)
    yield from ("--chdir", "/", "--")
