"""Limits of sockets: who may open one, how many, and how much may be sent."""

from collections import Counter
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Final
from urllib.parse import urlsplit

from starlette.requests import HTTPConnection
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocketClose

from ..service.security import Rate

MESSAGES: Final = Rate(per_second=400.0, burst=800)
"""Messages on one socket."""

SOCKETS: Final = 16
"""Open sockets of one address."""

SESSIONS: Final = Rate(per_second=0.2, burst=30)
"""New sessions of one address: each is a folder on the disk."""

JOIN_S: Final = 10.0
"""Time from the opening of a socket to its first message [s]."""


def same_origin(connection: HTTPConnection) -> bool:
    """Return whether a request comes from a page of this server: browsers let any page ask.

    A request without an origin is none of a page's.
    """
    origin = urlsplit(connection.headers.get("origin", ""))
    host = connection.headers.get("host", "")
    return bool(host) and origin.netloc.lower() == host.lower()


class KnownHosts:
    """ASGI middleware: answers requests for names of this machine, and for no others.

    A page elsewhere can let its own name stand for this machine; then its origin is our host.

    Parameters
    ----------
    app
        The application.
    names
        The names, such as ``localhost``; without any, all are known.
    """

    def __init__(self, app: ASGIApp, names: Collection[str]) -> None:
        self.app, self.names = app, names

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] in ("http", "websocket") and self.names:
            name = urlsplit(f"//{HTTPConnection(scope).headers.get('host', '')}").hostname
            if name not in self.names:
                if scope["type"] == "websocket":
                    await WebSocketClose()(scope, receive, send)
                    return
                known = ", ".join(sorted(self.names))
                message = f"this page is at {known}; behind a reverse proxy it needs --root"
                await JSONResponse({"error": message}, 421)(scope, receive, send)
                return
        await self.app(scope, receive, send)


@dataclass
class Places:
    """Places that each client may take so many of.

    Parameters
    ----------
    most
        Places of one client.
    """

    most: int
    _taken: Counter[str] = field(default_factory=Counter)

    @contextmanager
    def held(self, client: str) -> Iterator[bool]:
        """Hold a place while the body runs; yield whether the client had one left."""
        free = self._taken[client] < self.most
        self._taken[client] += free
        try:
            yield free
        finally:
            self._taken[client] -= free
            if not self._taken[client]:
                del self._taken[client]
