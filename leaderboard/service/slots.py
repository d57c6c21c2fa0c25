"""Limits on concurrent uploads, downloads and streams, per client and in total."""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass, field

from colift.leaderboard.service.errors import CLOSE, log, problem
from colift.leaderboard.service.security import seconds
from fastapi import Response
from starlette.types import Receive, Scope, Send


@dataclass(kw_only=True)
class Slots:
    """Slots that clients share."""

    what: str
    """The activity in a slot, in the plural, for messages."""
    each: int
    """Number of slots of one client."""
    total: int
    patience_s: float
    """Longest wait for a slot [s]."""
    _clients: dict[str, "_Client"] = field(default_factory=dict)
    _all: asyncio.Semaphore = field(init=False)

    def __post_init__(self) -> None:
        self._all = asyncio.Semaphore(self.total)

    @asynccontextmanager
    async def held(self, client: str) -> AsyncIterator[None]:
        """Hold a slot while the body runs.

        Raises
        ------
        HTTPException
            429 if the client has all of its slots, 503 if all others are taken.
        """
        end = asyncio.get_running_loop().time() + self.patience_s
        own = self._clients.setdefault(client, _Client(asyncio.Semaphore(self.each)))
        own.waiting += 1
        try:
            message = f"{self.each} {self.what} of yours are under way; wait for one to end"
            await _acquire(own.places, end, 429, message)
            try:
                message = f"{self.total} {self.what} are under way; try again later"
                await _acquire(self._all, end, 503, message)
                try:
                    yield
                finally:
                    self._all.release()
            finally:
                own.places.release()
        finally:
            own.waiting -= 1
            if not own.waiting:
                del self._clients[client]


@dataclass
class _Client:
    places: asyncio.Semaphore
    waiting: int = 0
    """Number of requests that wait for a slot or hold one."""


class Slotted(Response):
    """An answer that is sent while a slot is held, and broken off when that takes too long."""

    def __init__(self, answer: Response, slots: Slots, client: str, longest_s: float) -> None:
        self.answer, self.slots, self.client, self.longest_s = answer, slots, client, longest_s
        self.background = None

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Send the answer."""
        async with self.slots.held(self.client):
            try:
                async with asyncio.timeout(self.longest_s):
                    await self.answer(scope, receive, send)
            except TimeoutError:
                # The server closes the connection, since the answer is not complete.
                log.warning("%s was read for %g s: broken off", scope["path"], self.longest_s)


async def _acquire(places: asyncio.Semaphore, end: float, status: int, message: str) -> None:
    try:
        async with asyncio.timeout_at(end):
            await places.acquire()
    except TimeoutError:
        raise problem(status, message, {**CLOSE, "Retry-After": seconds(10.0)}) from None
