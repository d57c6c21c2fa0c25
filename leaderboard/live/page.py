"""The web process's end of a page's socket: slow pages lose their oldest frames, no sentence."""

import asyncio
import contextlib
import json
from collections import deque
from collections.abc import Callable, Mapping
from typing import Any, Final

from starlette.websockets import WebSocket, WebSocketDisconnect

from ..service.security import RateLimit
from .limits import MESSAGES

NORMAL: Final = 1000
"""Close code: nothing more is said."""

TAKEN_OVER: Final = 4001
"""Close code: another window has this seat."""

REFUSED: Final = 4003
"""Close code: the page need not come back."""

TOO_SLOW: Final = 4008
"""Close code: the page takes so little that sentences wait."""

LAST_S: Final = 3.0
"""What a page has to take its last message [s]."""

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


class Page:
    """A page of a browser: messages to it never wait, and it may send no flood.

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
        """Frames that the page was too slow for."""
        return self._outbox.dropped

    @property
    def ended(self) -> bool:
        """Whether the page was sent its last message."""
        return self._code is not None

    def send(self, message: Message) -> None:
        """Send a message, as soon as the page takes it."""
        if self._code is None and not self._outbox.put(message):
            self._finish(TOO_SLOW)

    def say(self, kind: str, **content: Any) -> None:
        """Send a control message."""
        self.send(json.dumps({"type": kind, **content}))

    def end(self, code: int, kind: str, message: str) -> None:
        """Send a last sentence, and close the socket."""
        self.say(kind, message=message)
        if self._code is None:
            self._finish(code)

    async def serve(self, received: Callable[[Message], None]) -> None:
        """Hand each message of the page on, until the page has gone or was ended."""
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
