"""How far a job is, as it happens: server-sent events."""

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable
from dataclasses import dataclass
from typing import Final

from .answers import JobAnswer

POLL_S: Final = 1.0
"""How often the database is asked [s]."""

ALIVE_S: Final = 15.0
"""After how long without news a comment is sent [s], so that nobody on the way hangs up."""

LONGEST_S: Final = 3600.0
"""After how long a stream ends [s]; a browser asks again by itself."""

MOST: Final = 100
"""Streams at the same time; whoever comes later polls."""


@dataclass
class Streams:
    """Counts the streams that are open."""

    open: int = 0

    @property
    def full(self) -> bool:
        """Whether no more may be opened."""
        return self.open >= MOST


async def events(
    first: JobAnswer, read: Callable[[], Awaitable[JobAnswer | None]], streams: Streams
) -> AsyncIterator[bytes]:
    """Yield an event ``job`` whenever the job has changed, until it has ended.

    Parameters
    ----------
    first
        The job as it is.
    read
        Returns it as it is now.
    streams
        Where this one is counted.
    """
    streams.open += 1
    try:
        clock = asyncio.get_running_loop().time
        began = told = clock()
        job: JobAnswer | None = first
        yield _event(first)
        while job and job.ended_at is None and clock() - began < LONGEST_S:
            await asyncio.sleep(POLL_S)
            now = await read()
            if now != job and now is not None:
                yield _event(now)
                told = clock()
            elif clock() - told > ALIVE_S:
                yield b": still here\n\n"
                told = clock()
            job = now
    finally:
        streams.open -= 1


def _event(job: JobAnswer) -> bytes:
    return f"event: job\ndata: {job.model_dump_json()}\n\n".encode()
