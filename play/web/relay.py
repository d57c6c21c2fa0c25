"""The web process's end of the socket to a room: packets, without waiting for either side."""

import asyncio
import contextlib
from collections import deque
from collections.abc import Callable
from typing import Final

from colift.play.rooms.process import LARGEST_PACKET, RoomProcess, parse_packet

AT_ONCE: Final = 64
"""Number of packets that are read before other tasks of the event loop have their turn."""

WAITING: Final = 1000
"""Number of packets that may wait for a room: with more, it has read none for seconds."""

END_S: Final = 5.0
"""Time for a room to end by itself after its socket was closed [s]."""


class RoomLink:
    """A room's process, seen from the event loop of the web process.

    Parameters
    ----------
    room
        The process, and the socket to it; one packet is one message.
    received
        Called with each packet's seat, kind and content.
    ended
        Called once when the room has ended by itself.
    """

    def __init__(
        self,
        room: RoomProcess,
        received: Callable[[int, bytes, bytes], None],
        ended: Callable[[], None],
    ) -> None:
        self.process = room.process
        self._channel = room.socket
        self._received, self._ended = received, ended
        self._waiting: deque[bytes] = deque()
        self._loop = asyncio.get_running_loop()
        self._open = True
        self._loop.add_reader(self._channel, self._read)

    def send(self, packet: bytes) -> None:
        """Send a packet to the room as soon as it takes it."""
        if not self._open:
            return
        self._waiting.append(packet)
        if len(self._waiting) == 1:
            self._write()
        elif len(self._waiting) > WAITING:
            self.process.kill()  # Its end of the socket is closed by that.

    async def close(self) -> None:
        """Close the socket, which ends the room, and wait until it has ended."""
        self._shut()
        await asyncio.to_thread(self.process.join, END_S)
        if self.process.is_alive():
            self.process.kill()
            await asyncio.to_thread(self.process.join)

    def _read(self) -> None:
        for _ in range(AT_ONCE):
            try:
                packet = self._channel.recv(LARGEST_PACKET)
            except BlockingIOError:
                return
            except OSError:
                packet = b""
            if len(packet) < 2:
                self._shut()
                self._ended()
                return
            self._received(*parse_packet(packet))
            if not self._open:
                return

    def _write(self) -> None:
        while self._waiting:
            try:
                self._channel.send(self._waiting[0])
            except BlockingIOError:
                self._loop.add_writer(self._channel, self._write)
                return
            except OSError:  # The reader finds the end, after all that the room has sent.
                self._waiting.clear()
                break
            self._waiting.popleft()
        self._loop.remove_writer(self._channel)

    def _shut(self) -> None:
        if self._open:
            self._open = False
            self._loop.remove_reader(self._channel)
            self._loop.remove_writer(self._channel)
            with contextlib.suppress(OSError):
                self._channel.close()
