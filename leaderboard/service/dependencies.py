"""Parameters that routes share: the service's state and parts of a request."""

import asyncio
from dataclasses import dataclass, field
from typing import Annotated, Any, Final
from urllib.parse import urlsplit

from colift.leaderboard.client import API
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.pages.links import Links
from colift.leaderboard.queue import Queue
from colift.leaderboard.service.documentation import Documentation
from colift.leaderboard.service.errors import Problem
from colift.leaderboard.service.security import Rate, RateLimit
from colift.leaderboard.service.slots import Slots
from colift.leaderboard.views.page import NAME, PARTS
from fastapi import Depends, Path, Query, Request

PLAY: Final = "/play"
"""Path of live lifts, below the board's root."""

PATIENCE_S: Final = 20.0
"""Longest wait of an upload or download for its turn [s]."""

UNPACKING: Final = 4
"""Number of uploads that are unpacked at the same time: it bounds their space on the disk."""


@dataclass(frozen=True, kw_only=True)
class Rates:
    """Rate limits of one client."""

    address: Rate = field(default_factory=lambda: Rate(per_second=50.0, burst=500))
    """Limit of requests from an address."""
    submitter: Rate = field(default_factory=lambda: Rate(per_second=0.1, burst=20))
    """Limit of uploads by a submitter."""


@dataclass(frozen=True, kw_only=True)
class ServiceState:
    """The state of a service."""

    board: Board
    queue: Queue
    tokens: Tokens
    uploads: RateLimit
    """Rate of uploads, by submitter."""
    name: str = NAME
    """Name of the board on its pages."""
    contact: str = ""
    """Contact of the maintainer."""
    address: str = ""
    """Address of the board for clients, without a slash at its end; empty if it is not known: the
    ``Host`` of a request is never taken for it."""
    docs: Documentation | None = None
    """The documentation that the pages link to."""
    play: bool = False
    """Whether the pages link to live lifts."""
    receiving: Slots = field(
        default_factory=lambda: Slots(what="uploads", each=2, total=32, patience_s=PATIENCE_S)
    )
    """Slots for uploads, by submitter."""
    unpacking: asyncio.Semaphore = field(default_factory=lambda: asyncio.Semaphore(UNPACKING))
    sending: Slots = field(
        default_factory=lambda: Slots(what="downloads", each=4, total=64, patience_s=PATIENCE_S)
    )
    """Slots for bundles, by address."""
    packing: asyncio.Lock = field(default_factory=asyncio.Lock)
    """Held while a bundle is packed."""
    streams: Slots = field(
        default_factory=lambda: Slots(what="streams", each=20, total=100, patience_s=0.0)
    )
    """Slots for streams of jobs, by address."""


def service_state(request: Request) -> ServiceState:
    """Return the state of the service that received a request."""
    state: ServiceState = request.app.state.service
    return state


Service = Annotated[ServiceState, Depends(service_state)]
"""The type of a route's parameter."""


SeasonName = Annotated[str, Path(pattern=f"^{PARTS['season']}$", description="Name of a season.")]
Digest = Annotated[
    str, Path(pattern=f"^{PARTS['digest']}$", description="Digest of a submission's content.")
]
JobId = Annotated[str, Path(pattern=f"^{PARTS['job']}$", description="A job.")]
SeasonAsked = Annotated[
    str | None,
    Query(
        pattern=f"^{PARTS['season']}$",
        description="Name of a season; by default the one that takes submissions.",
    ),
]
_WORD: Final = r"^[A-Za-z0-9_-]{1,40}$"
BehaviourAsked = Annotated[
    str | None,
    Query(
        pattern=_WORD,
        description="A behaviour, such as `jerky`: each row also has its public lifts of that "
        "behaviour, subject by subject.",
    ),
]
SubjectAsked = Annotated[
    str | None,
    Query(
        pattern=_WORD,
        description="A subject, such as `S1`: each row also has its public lifts with it, "
        "behaviour by behaviour.",
    ),
]

BINARY: Final = {"type": "string", "format": "binary"}

MISSING: Final[dict[int | str, dict[str, Any]]] = {
    404: {"model": Problem, "description": "It does not exist."}
}

UNKNOWN: Final[dict[int | str, dict[str, Any]]] = {
    401: {"model": Problem, "description": "The token is missing or not valid."}
}


def api_root(request: Request) -> str:
    """Return the address of the API for the client: a proxy may have put it below a path."""
    return f"{request.scope.get('root_path', '').rstrip('/')}{API}"


def origin_of(request: Request) -> str:
    """Return scheme and host of the board for clients; nothing if they are not known."""
    parts = urlsplit(service_state(request).address)
    return f"{parts.scheme}://{parts.netloc}" if parts.netloc else ""


def links_of(request: Request) -> Links:
    """Return the addresses of the pages for the client."""
    root = str(request.scope.get("root_path", "")).rstrip("/")
    state = service_state(request)
    return Links(
        root,
        "" if state.docs is None else state.docs.link(root),
        f"{root}{PLAY}/" if state.play else "",
    )
