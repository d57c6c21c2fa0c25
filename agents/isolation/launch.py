"""How a fork server is started on each rung of the ladder."""

import shutil
from collections.abc import Iterator
from typing import Any, Final

from .view import AGENTS, View, environment

BUBBLEWRAP: Final = "bubblewrap"
LANDLOCK: Final = "landlock"
LIMITS: Final = "limits"

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
from colift.agents.isolation.forkserver import main
main(int(handle))
"""
"""Makes a ``colift`` that has nothing but ``colift.agents``, whatever is beside it."""

_PRIVILEGES: Final = (
    "SYS_ADMIN",
    "SETUID",
    "SETGID",
    "SETPCAP",
    "SETFCAP",
    "KILL",
    "DAC_READ_SEARCH",
)
"""What the superuser's fork server needs to make cells."""


def command(rung: str, view: View, handle: int, *, superuser: bool) -> list[str]:
    """Return the command that starts a fork server.

    Parameters
    ----------
    rung
        Name of the rung.
    view
        What it may see.
    handle
        File descriptor of its orders.
    superuser
        Whether it will be started by the superuser.

    Raises
    ------
    FileNotFoundError
        If a program that the rung needs is not installed.
    """
    packages = [str(each) for each in view.packages]
    options = ["-s", "-P", "-S", "-u", "-c", _BOOTSTRAP]
    python = [str(view.python), *options, str(AGENTS), str(handle), *packages]
    return [*_bubblewrap(view, superuser), *python] if rung == BUBBLEWRAP else python


def settings(rung: str, view: View) -> dict[str, Any]:
    """Return what the fork server must know of its rung."""
    mounted = rung == BUBBLEWRAP
    return {
        "namespaces": rung != LIMITS,
        "landlock": rung != LIMITS,
        "seccomp": rung != LIMITS,
        "mounted": mounted,
        "readable": [str(path) for path in view.outermost()],
        "hidden": [] if mounted else [str(path) for path in view.hidden],
        "visible": [str(path) for path in view.visible()],
    }


def _bubblewrap(view: View, superuser: bool) -> Iterator[str]:
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
    yield from _binds(view)
    yield from ("--chdir", "/", "--")


def _binds(view: View) -> Iterator[str]:
    for path in view.readable:
        if path.is_symlink():
            yield from ("--symlink", str(path.readlink()), str(path))
        elif path != AGENTS:
            yield from ("--ro-bind", str(path), str(path))
    for path in view.hidden:
        if path != AGENTS / "humans":
            yield from ("--tmpfs", str(path))
    yield from ("--ro-bind", str(AGENTS), str(AGENTS), "--tmpfs", str(AGENTS / "humans"))
