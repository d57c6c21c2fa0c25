"""The web process: one event loop with all pages and the near ends of all rooms."""

import asyncio
import logging
import os
import signal
import socket
from typing import Final, cast

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

from ..service.server import make_server
from .app import create_play
from .keeper import PlayConfig
from .replaying import tether

SENDING: Final = 8192
"""Size of the system's buffer of what is sent to a page: seconds of frames, not minutes."""


class SmallBuffers(WebSocketsSansIOProtocol):
    """WebSockets that hold little of what a page has not taken.

    What waits must wait where the oldest frames can be dropped, in :class:`.Outbox`.
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
    logging.basicConfig(level=logging.WARNING, format="%(asctime)s %(levelname)s %(message)s")
    make_server(create_play(config), root, SmallBuffers).run(sockets=[listener])
