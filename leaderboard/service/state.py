"""What the routes work with: one board, its queue and tokens, and who may do how much."""

import asyncio
from dataclasses import dataclass, field
from typing import Annotated, Final

from fastapi import Depends, Request

from ..board import Board
from ..queue import Queue
from ..tokens import Tokens
from .progress import Streams
from .security import Rate, RateLimit

UPLOADS: Final = 8
"""Uploads that are received at the same time; the others wait. It bounds what they take on the
disk."""


@dataclass(frozen=True, kw_only=True)
class Rates:
    """How often one client may ask."""

    address: Rate = field(default_factory=lambda: Rate(per_second=50.0, burst=500))
    """Of requests from an address."""
    submitter: Rate = field(default_factory=lambda: Rate(per_second=0.1, burst=20))
    """Of uploads by a submitter."""


@dataclass(frozen=True, kw_only=True)
class State:
    """The state of a service."""

    board: Board
    queue: Queue
    tokens: Tokens
    uploads: RateLimit
    """By submitter."""
    slots: asyncio.Semaphore = field(default_factory=lambda: asyncio.Semaphore(UPLOADS))
    streams: Streams = field(default_factory=Streams)


def state_of(request: Request) -> State:
    """Return the state of the service that a request has come to."""
    state: State = request.app.state.service
    return state


Service = Annotated[State, Depends(state_of)]
"""The type of a route's parameter."""
