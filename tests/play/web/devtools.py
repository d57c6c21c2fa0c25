"""A browser by its own protocol, DevTools: nothing stands between it and a simulated person.

Playwright hears of every message of a WebSocket, some 500 a second of two pages, in a process of
its own that shares the machine with the table: people's eyes and hands do not.
"""

import asyncio
import contextlib
import itertools
import json
import tempfile
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from typing import Any

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed

QUIET = (
    "--headless",
    "--no-sandbox",
    "--no-first-run",
    "--mute-audio",
    "--hide-scrollbars",
    "--disable-extensions",
    "--disable-component-update",
    "--disable-background-networking",
    "--disable-background-timer-throttling",
    "--disable-backgrounding-occluded-windows",
    "--disable-renderer-backgrounding",
    "--disable-dev-shm-usage",
)
"""Options of a browser without a window or work of its own; pages in the background are awake."""

Answer = dict[str, Any]


class Browser:
    """A browser, connected."""

    def __init__(self, socket: ClientConnection) -> None:
        self._socket = socket
        self._numbers = itertools.count()
        self._asked: dict[int, asyncio.Future[Answer]] = {}
        self._sending: set[asyncio.Future[None]] = set()
        self._heard: dict[str, Callable[[str, Answer], None]] = {}

    def send(self, method: str, session: str | None = None, **content: Any) -> asyncio.Future[Any]:
        """Send a command at once; return the answer to come."""
        number = next(self._numbers)
        message = {"id": number, "method": method, "params": content}
        if session is not None:
            message["sessionId"] = session
        answer = self._asked[number] = asyncio.get_running_loop().create_future()
        sending = asyncio.ensure_future(self._socket.send(json.dumps(message)))
        self._sending.add(sending)

        def sent(sending: asyncio.Future[None]) -> None:
            self._sending.discard(sending)
            if not sending.cancelled() and (error := sending.exception()) and not answer.done():
                answer.set_exception(error)

        sending.add_done_callback(sent)
        return answer

    async def open(self, hear: Callable[[str, Answer], None], size: tuple[int, int]) -> "Tab":
        """Open an empty page in a context of its own; ``hear`` gets its calls of bindings."""
        context = (await self.send("Target.createBrowserContext"))["browserContextId"]
        target = await self.send(
            "Target.createTarget",
            url="about:blank",
            browserContextId=context,
            width=size[0],
            height=size[1],
        )
        found = await self.send("Target.attachToTarget", targetId=target["targetId"], flatten=True)
        tab = Tab(self, target["targetId"], found["sessionId"])
        self._heard[tab.session] = hear
        width, height = size
        await tab.send("Page.enable")
        await tab.send("Runtime.enable")
        await tab.send("Emulation.setFocusEmulationEnabled", enabled=True)
        await tab.send(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=False,
        )
        return tab

    async def listen(self) -> None:
        """Hand on what the browser says, until it has ended; nobody waits for it any longer."""
        while True:
            try:
                text = await self._socket.recv()
            except ConnectionClosed as closed:
                for answer in self._asked.values():
                    if not answer.done():
                        answer.set_exception(closed)
                return
            message = json.loads(text)
            number = message.get("id")
            if number is None:
                if message["method"] == "Runtime.bindingCalled":
                    told = message["params"]
                    self._heard[message["sessionId"]](told["name"], json.loads(told["payload"]))
                continue
            answer = self._asked.pop(number)
            if answer.done():
                continue
            if "error" in message:
                answer.set_exception(RuntimeError(message["error"]["message"]))
            else:
                answer.set_result(message["result"])


class Tab:
    """A page of a browser."""

    def __init__(self, browser: Browser, target: str, session: str) -> None:
        self._browser = browser
        self._target = target
        self.session = session

    def send(self, method: str, **content: Any) -> asyncio.Future[Any]:
        """Send a command at once; return the answer to come."""
        return self._browser.send(method, self.session, **content)

    async def evaluate(self, script: str) -> Any:
        """Return the value of an expression, or of its promise."""
        answer = await self.send(
            "Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True
        )
        if "exceptionDetails" in answer:
            raise RuntimeError(json.dumps(answer["exceptionDetails"]))
        return answer["result"].get("value")

    async def wait_for(self, script: str, seconds: float = 30.0) -> Any:
        """Return the value of an expression as soon as it is true."""
        async with asyncio.timeout(seconds):
            while not (value := await self.evaluate(script)):
                await asyncio.sleep(0.05)
        return value

    async def close(self) -> None:
        """Close the page."""
        await self._browser.send("Target.closeTarget", targetId=self._target)


@asynccontextmanager
async def browsing(executable: str) -> AsyncIterator[Browser]:
    """Start a browser; it ends with the context."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        process = await asyncio.create_subprocess_exec(
            executable,
            *QUIET,
            "--remote-debugging-port=0",
            f"--user-data-dir={profile}",
            stderr=asyncio.subprocess.PIPE,
        )
        assert process.stderr is not None
        try:
            line = b""
            while b"ws://" not in line:
                line = await process.stderr.readline()
                assert line, "the browser has ended"
            draining = asyncio.ensure_future(process.stderr.read())
            place = line.decode().split()[-1]
            async with connect(place, compression=None, max_size=None, max_queue=None) as socket:
                browser = Browser(socket)
                listening = asyncio.ensure_future(browser.listen())
                yield browser
                listening.cancel()
            draining.cancel()
        finally:
            with contextlib.suppress(ProcessLookupError):
                process.terminate()
            await process.wait()
