"""Limits of sockets: origin, number, and rate of messages."""

from collections import Counter
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Final
from urllib.parse import urlsplit

from colift.leaderboard.service.security import Rate
from starlette.requests import HTTPConnection
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocketClose

MESSAGES: Final = Rate(per_second=400.0, burst=800)
"""Rate of messages on one socket."""

SOCKETS: Final = 16
"""Number of open sockets of one address."""

SESSIONS: Final = Rate(per_second=0.2, burst=30)
"""Rate of new sessions of one address: each is a folder on the disk."""

JOIN_S: Final = 10.0
"""Time from the opening of a socket to its first message [s]."""


def same_origin(connection: HTTPConnection) -> bool:
    """Return whether a request comes from a page of this server: browsers allow any page to ask.

    A request without an origin does not come from a page.
    """
    origin = urlsplit(connection.headers.get("origin", ""))
    host = connection.headers.get("host", "")
    return bool(host) and origin.netloc.lower() == host.lower()


class KnownHosts:
    """ASGI middleware that answers only requests for names of this machine.

    Another site can make its own name point to this machine; then its origin equals our host.

    Parameters
    ----------
    app
        The application.
    names
        The names, such as ``localhost``; empty allows all.
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
    """Places, of which each client may take a limited number.

    Parameters
    ----------
    most
        Number of places per client.
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
