"""The web process's end of a page's socket: slow pages lose old frames, but no control message."""

import asyncio
import contextlib
import json
from collections import deque
from collections.abc import Callable, Mapping
from typing import Any, Final

from colift.leaderboard.service.security import RateLimit
from colift.play.web.limits import MESSAGES
from starlette.websockets import WebSocket, WebSocketDisconnect

NORMAL: Final = 1000
"""Close code: the last message was sent."""

TAKEN_OVER: Final = 4001
"""Close code: another window has this seat."""

REFUSED: Final = 4003
"""Close code: the page should not reconnect."""

TOO_SLOW: Final = 4008
"""Close code: the page reads so slowly that control messages wait."""

LAST_S: Final = 3.0
"""Time for a page to take its last message [s]."""

WAITING: Final = 100
"""Number of messages that may wait for one page: a second of frames."""

Message = str | bytes
"""Text is a control message, bytes are a frame."""


class Outbox:
    """A bounded queue to one page.

    Parameters
    ----------
    most
        Number of messages that may wait.
    """

    def __init__(self, most: int = WAITING) -> None:
        self._most = most
        self._waiting: deque[Message] = deque()
        self._filled = asyncio.Event()
        self._closed = False
        self.dropped = 0
        """Number of dropped frames."""

    def put(self, message: Message) -> bool:
        """Add a message at once; return False if the queue is full of control messages."""
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
        """Make :meth:`get` return None after all waiting messages."""
        self._closed = True
        self._filled.set()

    async def get(self) -> Message | None:
        """Return the oldest message; wait for one."""
        while not self._waiting and not self._closed:
            self._filled.clear()
            await self._filled.wait()
        return self._waiting.popleft() if self._waiting else None


class Page:
    """A page of a browser: sending to it never blocks, and its own messages are limited in rate.

    Parameters
    ----------
    socket
        Its socket, accepted.
    """

    def __init__(self, socket: WebSocket) -> None:
        self._socket = socket
        self._outbox = Outbox()
        self._rate = RateLimit(rate=MESSAGES, most=1)
        self._code: int | None = None
        self._writer: asyncio.Task[None] | None = None

    @property
    def dropped(self) -> int:
        """Number of frames that the page was too slow for."""
        return self._outbox.dropped

    @property
    def ended(self) -> bool:
        """Whether the page was sent its last message."""
        return self._code is not None

    def send(self, message: Message) -> None:
        """Send a message as soon as the page takes it."""
        if self._code is None and not self._outbox.put(message):
            self._finish(TOO_SLOW)

    def say(self, kind: str, **content: Any) -> None:
        """Send a control message."""
        self.send(json.dumps({"type": kind, **content}))

    def end(self, code: int, kind: str, message: str) -> None:
        """Send a last message, and close the socket."""
        self.say(kind, message=message)
        if self._code is None:
            self._finish(code)

    async def serve(self, received: Callable[[Message], None]) -> None:
        """Pass each message of the page on, until the page has gone or was ended."""
        reader = asyncio.create_task(self._read(received))
        writer = self._writer = asyncio.create_task(self._write())
        tasks = {reader, writer}
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
            if self._code is not None:
                await asyncio.wait({writer}, timeout=LAST_S)
        finally:
            for task in tasks:
                task.cancel()
            results = await asyncio.gather(*tasks, return_exceptions=True)
        for result in results:
            if isinstance(result, Exception):
                raise result

    def _finish(self, code: int) -> None:
        self._code = code
        self._outbox.close()
        if self._writer is not None:  # It may wait for a page that takes nothing.
            asyncio.get_running_loop().call_later(LAST_S, self._writer.cancel)

    async def _read(self, received: Callable[[Message], None]) -> None:
        while True:
            event: Mapping[str, Any] = await self._socket.receive()
            if event["type"] != "websocket.receive" or self._code is not None:
                return
            if self._rate.wait(""):
                most = f"{MESSAGES.per_second:.0f} messages a second"
                self.end(REFUSED, "refused", f"This page has sent more than {most}.")
                return
            text = event.get("text")
            received(event["bytes"] if text is None else text)

    async def _write(self) -> None:
        with contextlib.suppress(WebSocketDisconnect):
            while (message := await self._outbox.get()) is not None:
                if isinstance(message, bytes):
                    await self._socket.send_bytes(message)
                else:
                    await self._socket.send_text(message)
            await self._socket.close(self._code or NORMAL)
