"""A network between a page and its server: a TCP proxy on loopback that delays what it relays.

A browser's own throttling leaves WebSockets alone.
"""

import asyncio
import contextlib
import multiprocessing
import selectors
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing.connection import Connection
from urllib.parse import urlsplit

from colift.play.rooms.priority import RELAY, take_turn

CHUNK = 2**16

SPAWN = multiprocessing.get_context("spawn")


class Network:
    """A way with delays: of what the page sends, and of what it gets [s].

    The proxy is a process: a thread would wait while the one that moves the hands has the
    interpreter.
    """

    def __init__(self, up: float = 0.0, down: float = 0.0) -> None:
        self.up = up
        self.down = down
        self._server = ("", 0)

    @contextmanager
    def before(self, url: str) -> Iterator[str]:
        """Stand before a server; yield the address of the way through here."""
        address = urlsplit(url)
        self._server = (str(address.hostname), int(address.port or 80))
        ours, theirs = SPAWN.Pipe()
        process = SPAWN.Process(target=self._run, args=(theirs,), daemon=True)
        process.start()
        try:
            yield f"http://127.0.0.1:{ours.recv()}{address.path}"
        finally:
            ours.send("close")
            process.join()
            ours.close()
            theirs.close()

    def _run(self, parent: Connection) -> None:
        take_turn(RELAY)
        with asyncio.Runner(loop_factory=_exact_loop) as runner:
            runner.run(self._serve(parent))

    async def _serve(self, parent: Connection) -> None:
        self._connections: set[asyncio.Task[None]] = set()
        over = asyncio.Event()
        asyncio.get_running_loop().add_reader(parent.fileno(), over.set)
        server = await asyncio.start_server(self._connected, "127.0.0.1", 0)
        parent.send(server.sockets[0].getsockname()[1])
        await over.wait()
        server.close()
        for connection in self._connections:
            connection.cancel()
        await asyncio.gather(*self._connections)
        await server.wait_closed()

    async def _connected(
        self, page_in: asyncio.StreamReader, page_out: asyncio.StreamWriter
    ) -> None:
        task = asyncio.current_task()
        assert task is not None
        self._connections.add(task)
        writers = [page_out]
        with contextlib.suppress(OSError, asyncio.CancelledError):
            server_in, server_out = await asyncio.open_connection(*self._server)
            writers.append(server_out)
            await asyncio.gather(
                self._relay(page_in, server_out, self.up),
                self._relay(server_in, page_out, self.down),
            )
        for writer in writers:
            writer.close()
        for writer in writers:
            with contextlib.suppress(OSError):
                await writer.wait_closed()
        self._connections.discard(task)

    async def _relay(
        self, source: asyncio.StreamReader, sink: asyncio.StreamWriter, delay: float
    ) -> None:
        """Relay until the source ends; every chunk is as late as the network is when it comes."""
        loop = asyncio.get_running_loop()
        queue: asyncio.Queue[tuple[float, bytes]] = asyncio.Queue()

        async def read() -> None:
            while data := await source.read(CHUNK):
                queue.put_nowait((loop.time() + delay, data))
            queue.put_nowait((loop.time(), b""))

        reading = asyncio.ensure_future(read())
        try:
            while (item := await queue.get())[1]:
                await asyncio.sleep(max(item[0] - loop.time(), 0.0))
                sink.write(item[1])
                await sink.drain()
            sink.close()
        finally:
            reading.cancel()
            await asyncio.gather(reading, return_exceptions=True)


def _exact_loop() -> asyncio.AbstractEventLoop:
    """Return a loop that sleeps to the microsecond: epoll rounds up to whole milliseconds."""
    return asyncio.SelectorEventLoop(selectors.SelectSelector())
