"""Addresses of commands that serve pages."""

import errno
import socket
from typing import Annotated, Final

import typer
from colift.base.errors import InputError

Host = Annotated[
    str,
    typer.Option(metavar="ADDRESS", help="Address to listen on; 0.0.0.0: all of this machine's."),
]
Port = Annotated[
    int, typer.Option(metavar="N", min=0, max=65535, help="Port to listen on; 0: any free one.")
]
LOOPBACK: Final = "127.0.0.1"
"""The default address: this machine alone."""


def listening_at(host: str, port: int) -> socket.socket:
    """Return a listening socket.

    Raises
    ------
    InputError
        If the address or the port cannot be used.
    """
    from colift.leaderboard.service.server import listening

    try:
        return listening(host, port)
    except OSError as error:
        reason = {
            errno.EADDRINUSE: f"port {port} is taken; choose another by --port (0: any free one)",
            errno.EACCES: f"port {port} needs more rights; choose one above 1023 by --port",
            errno.EADDRNOTAVAIL: "this machine has no such address; try 127.0.0.1 or 0.0.0.0",
        }.get(error.errno or 0, error.strerror)
        raise InputError(f"cannot listen on {host}:{port}: {reason}") from error


def url_of(listener: socket.socket) -> str:
    """Return the address of a listening socket for a browser on this machine."""
    host, port = listener.getsockname()[:2]
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"
