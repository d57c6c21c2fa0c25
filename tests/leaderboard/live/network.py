"""A network between a page and its server: a TCP proxy on loopback that delays what it relays.

A browser's own throttling leaves WebSockets alone.
"""

import asyncio
import contextlib
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from urllib.parse import urlsplit

CHUNK = 2**16


class Network:
    """Delays that may be changed while connections are open."""

    def __init__(self, up: float = 0.0, down: float = 0.0) -> None:
        self.up = up
        """Delay of what the page sends [s]."""
        self.down = down
        """Delay of what the page gets [s]."""
        self._server = ("", 0)
        self._connections: set[asyncio.Task[None]] = set()

    @contextmanager
    def before(self, url: str) -> Iterator[str]:
        """Stand before a server, in a thread; yield the address of the way through here."""
        address = urlsplit(url)
        self._server = (str(address.hostname), int(address.port or 80))
        opened: Future[tuple[int, Callable[[], object]]] = Future()
        thread = threading.Thread(target=lambda: asyncio.run(self._serve(opened)))
        thread.start()
        port, close = opened.result()
        try:
            yield f"http://127.0.0.1:{port}{address.path}"
        finally:
            close()
            thread.join()

    async def _serve(self, opened: "Future[tuple[int, Callable[[], object]]]") -> None:
        loop, over = asyncio.get_running_loop(), asyncio.Event()
        server = await asyncio.start_server(self._connected, "127.0.0.1", 0)
        port = server.sockets[0].getsockname()[1]
        opened.set_result((port, lambda: loop.call_soon_threadsafe(over.set)))
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
                self._relay(page_in, server_out, "up"), self._relay(server_in, page_out, "down")
            )
        for writer in writers:
            writer.close()
        for writer in writers:
            with contextlib.suppress(OSError):
                await writer.wait_closed()
        self._connections.discard(task)

    async def _relay(
        self, source: asyncio.StreamReader, sink: asyncio.StreamWriter, way: str
    ) -> None:
        """Relay until the source ends; every chunk is as late as the network is when it comes."""
        loop = asyncio.get_running_loop()
        queue: asyncio.Queue[tuple[float, bytes]] = asyncio.Queue()

        async def read() -> None:
            while data := await source.read(CHUNK):
                queue.put_nowait((loop.time() + getattr(self, way), data))
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
