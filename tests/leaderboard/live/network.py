"""A network between a page and its server: a TCP proxy on loopback that delays what it relays.

A browser's own throttling leaves WebSockets alone.
"""

import asyncio
import contextlib
import threading
from collections.abc import Iterator
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
        self.frozen = False
        """Whether nothing gets through, while connections stay open: a segment was lost."""
        self._server = ("", 0)

    @contextmanager
    def before(self, url: str) -> Iterator[str]:
        """Stand before a server, in a thread; yield the address of the way through here."""
        address = urlsplit(url)
        assert address.hostname is not None
        assert address.port is not None
        self._server = (address.hostname, address.port)
        loop, opened = asyncio.new_event_loop(), threading.Event()
        ports: list[int] = []

        async def serve() -> None:
            server = await asyncio.start_server(self._connected, "127.0.0.1", 0)
            ports.append(server.sockets[0].getsockname()[1])
            opened.set()
            async with server:
                with contextlib.suppress(asyncio.CancelledError):
                    await server.serve_forever()

        task = loop.create_task(serve())

        def run() -> None:
            asyncio.set_event_loop(loop)
            loop.run_until_complete(task)
            left = asyncio.all_tasks(loop)
            for each in left:
                each.cancel()
            loop.run_until_complete(asyncio.gather(*left, return_exceptions=True))
            loop.close()

        thread = threading.Thread(target=run)
        thread.start()
        opened.wait()
        try:
            yield f"http://127.0.0.1:{ports[0]}{address.path}"
        finally:
            loop.call_soon_threadsafe(task.cancel)
            thread.join()

    async def _connected(
        self, page_in: asyncio.StreamReader, page_out: asyncio.StreamWriter
    ) -> None:
        try:
            server_in, server_out = await asyncio.open_connection(*self._server)
        except OSError:
            page_out.close()
            return
        with contextlib.suppress(asyncio.CancelledError):
            await asyncio.gather(
                self._relay(page_in, server_out, "up"), self._relay(server_in, page_out, "down")
            )

    async def _relay(
        self, source: asyncio.StreamReader, sink: asyncio.StreamWriter, way: str
    ) -> None:
        """Relay until the source ends; every chunk is as late as the network is when it comes."""
        loop = asyncio.get_running_loop()
        queue: asyncio.Queue[tuple[float, bytes]] = asyncio.Queue()

        async def send() -> None:
            while (item := await queue.get())[1]:
                await asyncio.sleep(max(item[0] - loop.time(), 0.0))
                while self.frozen:
                    await asyncio.sleep(0.001)
                sink.write(item[1])
                await sink.drain()

        sending = asyncio.ensure_future(send())
        try:
            while data := await source.read(CHUNK):
                queue.put_nowait((loop.time() + getattr(self, way), data))
        except ConnectionError:
            pass
        finally:
            queue.put_nowait((loop.time(), b""))
            with contextlib.suppress(ConnectionError):
                await sending
            sink.close()
