"""The server process: its socket, its HTTP server and its worker processes."""

import asyncio
import contextlib
import logging
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from types import FrameType
from typing import Final

import uvicorn
from fastapi import FastAPI

UNREAD_S: Final = 60
"""Time after which the system drops a connection whose client reads nothing of an answer [s]."""

LISTENING: Final = 2048
"""Number of connections that may wait to be accepted."""


def listening(host: str, port: int) -> socket.socket:
    """Return a listening socket; :class:`OSError` if that is not possible here."""
    family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
    listener = socket.create_server((host, port), family=family, backlog=LISTENING)
    # What is accepted inherits it.
    listener.setsockopt(socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT, 1000 * UNREAD_S)
    return listener


GRACE_S: Final = 3
"""Time for open connections to end when the service ends [s]."""


SOCKET_BYTES: Final = 4096
"""Longest message that a client may send on a WebSocket."""

PING_S: Final = 10.0
"""Time between two pings of a WebSocket, and longest time to its answer [s]."""


class _Server(uvicorn.Server):
    """A server that ignores further signals while it ends: a second one would not wait."""

    def handle_exit(self, sig: int, frame: FrameType | None) -> None:
        if not self.should_exit:
            super().handle_exit(sig, frame)


def make_server(
    app: FastAPI, root: str = "", sockets: type[asyncio.Protocol] | None = None
) -> uvicorn.Server:
    """Return a server of an application; it uses the existing loggers.

    Parameters
    ----------
    app
        The application.
    root
        Path below which a proxy shows it, such as ``/board``; the proxy removes it from requests.
    sockets
        Protocol of WebSockets; None serves no WebSockets.
    """
    config = uvicorn.Config(
        app,
        root_path=root,
        log_config=None,
        access_log=False,
        server_header=False,
        timeout_graceful_shutdown=GRACE_S,
        ws="none" if sockets is None else sockets,
        ws_max_size=SOCKET_BYTES,
        ws_per_message_deflate=False,  # Frames are small, and come 100 times a second.
        ws_ping_interval=PING_S,
        ws_ping_timeout=PING_S,
    )
    return _Server(config)


log: Final = logging.getLogger("colift.service")

LOOK_S: Final = 0.5
"""Time between two checks of the workers [s]."""

PAUSE_S: Final = 1.0
"""Wait before a worker is started again [s]; it doubles each time the worker ends again soon."""

LONGEST_PAUSE_S: Final = 60.0

WORKER_GRACE_S: Final = 10.0
"""Time for a worker to end by itself [s]."""

# Also when this process is killed, so that those of the next one are not too many.
_TETHER: Final = """
import ctypes, os, signal, sys
ctypes.CDLL(None, use_errno=True).prctl(1, signal.SIGTERM)  # PR_SET_PDEATHSIG
if os.getppid() == int(sys.argv[1]):
    os.execv(sys.argv[2], sys.argv[2:])
"""


@contextmanager
def running(command: Sequence[str], count: int) -> Iterator[None]:
    """Keep a number of processes running while the body runs.

    Parameters
    ----------
    command
        The command of each: a program's path, and its arguments.
    count
        Number of processes.
    """
    stop = threading.Event()
    keepers = [
        threading.Thread(target=_keep, args=(command, stop), name=f"worker {number + 1}")
        for number in range(count)
    ]
    for keeper in keepers:
        keeper.start()
    try:
        yield
    finally:
        stop.set()
        for keeper in keepers:
            keeper.join()


def _keep(command: Sequence[str], stop: threading.Event) -> None:
    """Run the command again and again, until ``stop`` is set."""
    pause = PAUSE_S
    while not stop.is_set():
        began = time.monotonic()
        process = start_worker(command)
        while process.poll() is None and not stop.wait(LOOK_S):
            pass
        if stop.is_set():
            _end(process)
            return
        pause = PAUSE_S if time.monotonic() - began > LONGEST_PAUSE_S else pause
        log.error("a worker ended with code %s; next in %.0f s", process.returncode, pause)
        stop.wait(pause)
        pause = min(2 * pause, LONGEST_PAUSE_S)


def start_worker(command: Sequence[str]) -> "subprocess.Popen[bytes]":
    """Start a process that is terminated when the calling thread ends for any reason."""
    tether = [sys.executable, "-c", _TETHER, str(os.getpid()), *command]
    # Ctrl-C in a terminal is for the service, which then ends its workers.
    return subprocess.Popen(tether, stdin=subprocess.DEVNULL, start_new_session=True)


def _end(process: "subprocess.Popen[bytes]") -> None:
    process.send_signal(signal.SIGTERM)
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(WORKER_GRACE_S)
    process.kill()
    process.wait()
