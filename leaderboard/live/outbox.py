"""Messages that wait for a page: a slow page loses its oldest frames, never a sentence."""

import asyncio
from collections import deque
from typing import Final

WAITING: Final = 100
"""Messages that wait for one page: a second of frames."""

Message = str | bytes
"""Text is a control message, bytes are a frame."""


class Outbox:
    """A bounded queue to one page.

    Parameters
    ----------
    most
        How many messages may wait.
    """

    def __init__(self, most: int = WAITING) -> None:
        self._most = most
        self._waiting: deque[Message] = deque()
        self._filled = asyncio.Event()
        self._closed = False
        self.dropped = 0
        """Frames that were dropped."""

    def put(self, message: Message) -> bool:
        """Add a message at once; False if there is no place, since only sentences wait."""
        if len(self._waiting) >= self._most:
            oldest = next((each for each in self._waiting if isinstance(each, bytes)), None)
            if oldest is None:
                return False
            self._waiting.remove(oldest)  # Equal frames are equal: the first of them goes.
            self.dropped += 1
        self._waiting.append(message)
        self._filled.set()
        return True

    def close(self) -> None:
        """Let :meth:`get` return None after all that waits."""
        self._closed = True
        self._filled.set()

    async def get(self) -> Message | None:
        """Return the oldest message; wait for one."""
        while not self._waiting and not self._closed:
            self._filled.clear()
            await self._filled.wait()
        return self._waiting.popleft() if self._waiting else None
