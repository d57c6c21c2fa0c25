"""Rate limits and security headers."""

import ipaddress
import math
import time
from collections import OrderedDict
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Final
from urllib.parse import urlsplit, urlunsplit

from fastapi.responses import JSONResponse
from starlette.datastructures import MutableHeaders
from starlette.requests import HTTPConnection
from starlette.types import ASGIApp, Message, Receive, Scope, Send

HEADERS: Final[Mapping[str, str]] = {
    # No content from elsewhere, no inline scripts, no frames around the pages.
    "Content-Security-Policy": (
        "default-src 'self'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'; "
        "object-src 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=()",
    "Cache-Control": "no-cache",
}
"""Headers of every answer that does not set them itself."""

IPV6_NETWORK: Final = 64
"""Number of leading bits of an IPv6 address that identify a subscriber."""


@dataclass(frozen=True, kw_only=True)
class Rate:
    """A rate limit."""

    per_second: float
    """Long-run rate [1/s]."""
    burst: int
    """Number of requests at once, after a pause."""


@dataclass(kw_only=True)
class RateLimit:
    """A token bucket for each of many clients; the least recent is forgotten."""

    rate: Rate
    most: int = 10_000
    """Number of clients that are remembered."""
    clock: Callable[[], float] = time.monotonic
    _buckets: OrderedDict[str, tuple[float, float]] = field(default_factory=OrderedDict)

    def wait(self, client: str) -> float:
        """Return 0 and count the request, or return the time that the client has to wait [s]."""
        now = self.clock()
        level, since = self._buckets.pop(client, (float(self.rate.burst), now))
        level = min(level + (now - since) * self.rate.per_second, self.rate.burst)
        missing = max(1 - level, 0.0)
        self._buckets[client] = (level if missing else level - 1, now)
        if len(self._buckets) > self.most:
            self._buckets.popitem(last=False)
        return missing / self.rate.per_second


class Guard:
    """ASGI middleware that sets the headers of every answer, and limits the rate of an address."""

    def __init__(self, app: ASGIApp, rate: Rate) -> None:
        self.app = app
        self.limit = RateLimit(rate=rate)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request, or refuse it with the time after which it may be repeated."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return

        async def guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers.setdefault(name, value)
                if "location" in headers:
                    headers["location"] = local_path(headers["location"])
            await send(message)

        names = [name for name, _ in scope["headers"]]
        if b"content-length" in names and b"transfer-encoding" in names:
            # A proxy could use one and this server the other: data would be taken for a request.
            message = "a request has Content-Length or Transfer-Encoding, not both"
            answer = JSONResponse({"error": message}, 400, {"Connection": "close"})
            await answer(scope, receive, guarded)
            return
        wait = self.limit.wait(client_of(HTTPConnection(scope)))
        if wait:
            message = f"too many requests from your address; try again in {seconds(wait)} s"
            answer = JSONResponse({"error": message}, 429, {"Retry-After": seconds(wait)})
            await answer(scope, receive, guarded)
            return
        await self.app(scope, receive, guarded)


def local_path(address: str) -> str:
    """Return the path of a redirect: its host came from the request, and was not checked."""
    parts = urlsplit(address)
    return urlunsplit(("", "", f"/{parts.path.lstrip('/')}", parts.query, parts.fragment))


def client_of(connection: HTTPConnection) -> str:
    """Return the client that a request counts for: the common part of a subscriber's addresses."""
    return network(connection.client.host if connection.client else "")


def network(address: str) -> str:
    """Return the common part of the addresses of one subscriber."""
    try:
        parsed = ipaddress.ip_address(address)
    except ValueError:
        return address
    if parsed.version == 4:
        return address
    return str(ipaddress.ip_network((parsed, IPV6_NETWORK), strict=False))


def seconds(wait: float) -> str:
    """Return a time rounded up to whole seconds."""
    return str(math.ceil(wait))
