"""The fork server: a small trusted process inside the sandbox that starts a cell an episode.

It has imported NumPy and what serves a policy, and nothing of a stranger's: what an episode's
process does to its modules dies with it.
"""

import contextlib
import gc
import importlib
import json
import os
import select
import signal
import socket
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from . import landlock, linux
from .cell import Ends, start
from .preload import serve_forks
from .probe import look
from .server import serve
from .walls import Walls

EPISODE: Final = b"e"
PRELOAD: Final = b"p"
PROBE: Final = b"q"

OURS: Final = "colift.agents."

SETTINGS: Final = 1 << 17
"""Longest message [bytes]."""

_TRIAL_SECONDS: Final = 5.0


def main(handle: int) -> None:
    """Serve orders on a socket until its other side closes."""
    orders = socket.socket(fileno=handle)
    settings = json.loads(orders.recv(SETTINGS))
    linux.hide(True)
    linux.become_subreaper()
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    gc.freeze()
    walls = _walls(settings)
    orders.send(json.dumps({"namespaces": walls.namespaces}).encode())
    with _scratch(walls) as walls:
        while True:
            order, handles, _, _ = socket.recv_fds(orders, SETTINGS, 3)
            if not order:
                return
            start(walls, Ends(*handles), _work(order[:1], json.loads(order[1:])))


@contextlib.contextmanager
def _scratch(walls: Walls) -> Iterator[Walls]:
    """Yield the walls with a folder to write in where they give none of their own.

    It is made and removed here, for this process outlives its owner, which may be killed.
    """
    if walls.mounted or walls.namespaces:
        yield walls
        return
    with tempfile.TemporaryDirectory(prefix="colift-", ignore_cleanup_errors=True) as folder:
        yield replace(walls, scratch=Path(folder))


def _work(kind: bytes, policy: Any) -> Callable[[int], None]:
    """Return what a cell does."""
    if kind == PROBE:
        return lambda handle: look(handle, policy)
    module = policy[0].partition(":")[0]
    if module.startswith(OURS) and module not in sys.modules:
        # What is colift's own is no stranger's: imported once for all episodes.
        with contextlib.suppress(Exception):
            importlib.import_module(module)
            gc.freeze()
    if kind == PRELOAD:
        return lambda handle: serve_forks(handle, *policy)
    return lambda handle: serve(handle, *policy)


def _walls(settings: dict[str, Any]) -> Walls:
    """Return the strongest walls that can be had here."""
    without = Walls(
        namespaces="",
        landlock=settings["landlock"] and landlock.version() > 0,
        seccomp=settings["seccomp"],
        readable=tuple(map(Path, settings["visible"])),
        hidden=(),
        mounted=settings["mounted"],
        folder=Path(settings["folder"]) if settings["folder"] else None,
        scratch=None,
        limits=settings["limits"],
    )
    if not settings["namespaces"]:
        return without
    for kind in ("root", "user") if os.geteuid() == 0 else ("user",):
        walls = replace(
            without,
            namespaces=kind,
            readable=tuple(map(Path, settings["readable"])),
            hidden=tuple(map(Path, settings["hidden"])),
        )
        if _stands(walls):
            return walls
    return without


def _stands(walls: Walls) -> bool:
    """Return whether a cell with these walls comes to serve."""
    here, there = socket.socketpair()
    watched, status = socket.socketpair()
    output = os.open("/dev/null", os.O_WRONLY)
    ends = Ends(there.detach(), output, status.detach())
    with contextlib.closing(here), contextlib.closing(watched):
        try:
            start(walls, ends, _say_yes)
        except OSError as error:
            os.write(ends.status, str(error).encode())
            for end in ends:
                os.close(end)
        if select.select([here], [], [], _TRIAL_SECONDS)[0] and here.recv(1) == b"y":
            return True
        watched.setblocking(False)
        with contextlib.suppress(OSError):
            print(
                f"namespaces by {walls.namespaces}:", watched.recv(1000).decode(), file=sys.stderr
            )
        return False


def _say_yes(handle: int) -> None:
    os.write(handle, b"y")
