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

from colift.agents.sandbox.host.control_group import ControlGroup
from colift.agents.sandbox.host.output import clean
from colift.agents.sandbox.host.view import View, environment, view
from colift.agents.sandbox.protocol import MIB, ORDER, REASON, SHOWN, Limits
from colift.base.errors import EvaluatorFault

BUBBLEWRAP: Final = "bubblewrap"
LANDLOCK: Final = "landlock"
LIMITS: Final = "limits"

READY_SECONDS: Final = 60.0
"""Time limit for the start of a fork server [s]."""

HEADROOM: Final = 256 * MIB
"""Memory of a control group beyond the policy's [bytes]: for the fork server with its imports, and
for the processes that watch."""

_CLOSE_SECONDS: Final = 5.0

_BOOTSTRAP: Final = """
import sys
from importlib.util import module_from_spec, spec_from_file_location
from types import ModuleType
base, agents, handle, *packages = sys.argv[1:]
sys.path += packages
colift = sys.modules["colift"] = ModuleType("colift")
colift.__path__ = []
for name, folder in ("base", base), ("agents", agents):
    spec = spec_from_file_location(
        "colift." + name, folder + "/__init__.py", submodule_search_locations=[folder]
    )
    part = sys.modules[spec.name] = module_from_spec(spec)
    setattr(colift, name, part)
    spec.loader.exec_module(part)
from colift.agents.sandbox.guest.forkserver import main
main(int(handle))
"""
"""Makes a package ``colift`` of two of its parts alone, whatever else is installed."""

_PRIVILEGES: Final = [
    "SYS_ADMIN",
    "SETUID",
    "SETGID",
    "SETPCAP",
    "SETFCAP",
    "KILL",
    "DAC_READ_SEARCH",
    "IPC_LOCK",
]
"""Capabilities with which the superuser's fork server makes namespaces, and locks pages."""


class ForkServer:
    """A running fork server; it ends with this object, or with the process that made it.

    Parameters
    ----------
    isolation
        Its isolation level.
    seen
        The file or folder that policies see besides Python; a folder is their working directory.
    limits
        The budgets of a policy in one episode.

    Raises
    ------
    EvaluatorFault
        If it does not start.
    """

    def __init__(self, isolation: str, seen: Path | None, limits: Limits) -> None:
        visible = view(seen)
        groups, doors = _groups(limits.memory + HEADROOM)
        self.orders, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        """The socket on which it takes orders."""
        with tempfile.TemporaryFile() as errors, contextlib.closing(theirs):
            try:
                words = command(isolation, visible, theirs.fileno(), superuser=os.geteuid() == 0)
                for group in groups[:1]:
                    words = group.entering([*words])
                self._process = subprocess.Popen(
                    words,
                    stdin=subprocess.DEVNULL,
                    stdout=errors,
                    stderr=errors,
                    pass_fds=[theirs.fileno(), *doors],
                    env=environment(),
                    cwd="/",
                    start_new_session=True,
                )
            except OSError as error:
                self.orders.close()
                for group in groups:
                    group.remove()
                raise EvaluatorFault(f"the {isolation} sandbox does not start: {error}") from error
            finally:
                for door in doors:
                    os.close(door)
            theirs.close()
            self.close = weakref.finalize(
                self, _end, os.getpid(), self._process, self.orders, groups
            )
            """End all of its processes."""
            try:
                settings = _settings(isolation, visible, seen, limits, doors)
                self.namespaces = self._introduce(settings)
                """Namespaces of an episode: made by ``root``, by the ``user``, or none (empty)."""
            except (OSError, ValueError) as error:
                self.close()
                errors.seek(0)
                said = clean(errors.read().decode(errors="replace")).strip() or str(error)
                raise EvaluatorFault(
                    f"the {isolation} sandbox does not start: {said[-REASON:]}"
                ) from error

    def _introduce(self, content: dict[str, Any]) -> str:
        """Send the fork server its settings, and return which namespaces it makes."""
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
    owner: int,
    process: subprocess.Popen[bytes],
    orders: socket.socket,
    groups: tuple[ControlGroup, ...],
) -> None:
    """End a fork server; in a fork of its owner, only close the socket."""
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
    for group in groups:
        group.remove()


def _groups(memory: int) -> tuple[tuple[ControlGroup, ...], tuple[int, ...]]:
    """Return a control group for all processes and one for lifts, and the door of the latter.

    A group that needs memory takes it from the files that its processes have read. Lifts read
    none: in a group of their own they cannot do that, so what they need shows on no file. Return
    nothing where this process may make no groups.
    """
    made: list[ControlGroup] = []
    try:
        made += [ControlGroup(memory)]
        made += [ControlGroup(memory)]
        return tuple(made), (made[1].door(),)
    except OSError:  # Not every machine allows one.
        for group in made:
            group.remove()
        return (), ()


def _settings(
    isolation: str, visible: View, seen: Path | None, limits: Limits, doors: tuple[int, ...]
) -> dict[str, Any]:
    """Return the settings of a fork server, for its :class:`.Restrictions`."""
    covered = isolation != LIMITS
    shown = visible.outermost() if covered else visible.visible()
    return {
        "namespaces": covered,
        "landlock": isolation == LANDLOCK,
        "readable": [str(path) for path in shown],
        "hidden": [str(path) for path in visible.hidden] if covered else [],
        "folder": str(seen) if seen and seen.is_dir() else "",
        "limits": asdict(limits),
        "doors": doors,
    }


def command(isolation: str, visible: View, handle: int, *, superuser: bool) -> list[str]:
    """Return the command that starts a fork server.

    It sees the ``visible`` files and takes orders on the file descriptor ``handle``; ``superuser``
    is whether the superuser will start it. Raise FileNotFoundError if bubblewrap is not installed.
    """
    packages = [str(each) for each in visible.packages]
    options = ["-s", "-P", "-S", "-u", "-c", _BOOTSTRAP]
    python = [str(visible.python), *options, *map(str, SHOWN), str(handle), *packages]
    return [*_bubblewrap(visible, superuser), *python] if isolation == BUBBLEWRAP else python


def _bubblewrap(visible: View, superuser: bool) -> Iterator[str]:
    program = shutil.which("bwrap")
    if program is None:
        raise FileNotFoundError("bwrap is not installed")
    yield program
    # The superuser's fork server keeps the capabilities to make processes that are nobody outside
    # their namespaces too, which a user namespace of bubblewrap's own would not allow.
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
