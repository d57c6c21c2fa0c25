"""The processes that serve live lifts: one with all pages, and its parent, which replaces it.

The parent keeps the address, and starts another web process if one is killed.
"""

import asyncio
import logging
import multiprocessing
import os
import signal
import socket
import time
from multiprocessing.context import SpawnProcess
from typing import Final, cast

from colift.base.errors import EvaluatorFault
from colift.leaderboard.logs import write_log
from colift.leaderboard.service.server import make_server
from colift.play.rooms.priority import RELAY, take_turn
from colift.play.web.app import create_play
from colift.play.web.keeper import PlayConfig
from colift.play.web.replaying import tether
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

log: Final = logging.getLogger("colift.play")

SOON_S: Final = 10.0
"""Running time below which a process counts as failed [s]."""

TRIES: Final = 3
"""Number of processes in succession that may end so soon."""

END_S: Final = 8.0
"""Time for the web process to end with its rooms [s]."""

SENDING: Final = 8192
"""Size of the system's send buffer for a page: seconds of frames, not minutes."""


class SmallBuffers(WebSocketsSansIOProtocol):
    """WebSockets with small send buffers.

    Messages must wait where the oldest frames can be dropped, in :class:`.Outbox`.
    """

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Take a connection over from HTTP."""
        connection = transport.get_extra_info("socket")
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SENDING)
        cast(asyncio.WriteTransport, transport).set_write_buffer_limits(high=0)
        super().connection_made(transport)


def run_web(config: PlayConfig, listener: socket.socket, root: str) -> None:
    """Serve live lifts until a signal ends this process, or its parent has ended.

    Parameters
    ----------
    config
        The partners, and the number of rooms.
    listener
        The listening socket.
    root
        Path below which a proxy shows the page, without a slash at its end.
    """
    os.setsid()  # Ctrl-C in a terminal is for the parent.
    tether(signal.SIGTERM)
    take_turn(RELAY)  # Frames and samples must not wait for less urgent work.
    write_log()
    make_server(create_play(config), root, SmallBuffers).run(sockets=[listener])


def keep_serving(config: PlayConfig, listener: socket.socket, root: str = "") -> None:
    """Keep a web process running until this one is interrupted.

    While there is none, new connections wait: the socket stays open here.

    Raises
    ------
    EvaluatorFault
        If several in succession end at once.
    """
    context = multiprocessing.get_context("spawn")
    failed = 0
    while True:
        process = context.Process(target=run_web, args=(config, listener, root), name="web")
        began = time.monotonic()
        process.start()
        try:
            process.join()
        finally:
            _end(process)
        failed = failed + 1 if time.monotonic() - began < SOON_S else 0
        if failed >= TRIES:
            raise EvaluatorFault(f"the web process ends at once, with code {process.exitcode}")
        log.error("the web process has ended with code %s; another is started", process.exitcode)


def _end(process: SpawnProcess) -> None:
    if process.is_alive():
        process.terminate()
        process.join(END_S)
    if process.is_alive():
        process.kill()
        process.join()
