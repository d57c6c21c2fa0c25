"""Simulated people at a real browser: their hands are trusted events with times of their own."""

import asyncio
import gc
import json
import struct
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from colift.agents.agent import FRAME, HISTORY, HumanObservation
from colift.agents.humans import Partner
from playwright.async_api import BrowserContext, CDPSession, Page

EVERY_S = 0.004
"""Time between two events: four to a picture, so that the browser coalesces them."""

COUNTS_PER_METRE = 5000.0
"""Of a mouse, as the page takes them."""

STEP = 10
"""Frames for which a second person decides at a time."""

Hand = Callable[[float], float]
"""Time of the lift [s] -> height of the hand above the grip [m]."""


class Driven:
    """A page whose person is simulated, with a locked mouse or with a finger.

    The room's clock is that of this machine.
    """

    def __init__(self, page: Page, session: CDPSession, finger: bool = False) -> None:
        self.page = page
        self.finger = finger
        self._cdp = session
        self.told: list[dict[str, Any]] = []
        self.frames: dict[int, tuple[float, float]] = {}
        page.on("websocket", self._listen)

    @classmethod
    async def opened(cls, context: BrowserContext, url: str, finger: bool = False) -> "Driven":
        page = await context.new_page()
        driven = cls(page, await context.new_cdp_session(page), finger)
        await page.goto(url)
        return driven

    def _listen(self, socket: Any) -> None:
        socket.on("framereceived", self._take)

    def _take(self, payload: str | bytes) -> None:
        if isinstance(payload, str):
            self.told.append(json.loads(payload))
            return
        frame, human, robot = struct.unpack_from("<Iff", payload, 4)
        self.frames[frame] = (human, robot)

    async def until(self, kind: str, after: int = 0, seconds: float = 30.0, **wanted: Any) -> Any:
        """Return the first message of a kind that comes after so many messages."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for told in self.told[after:]:
                if told["type"] == kind and wanted.items() <= told.items():
                    return told
            await asyncio.sleep(0.01)
        raise TimeoutError(f"no {kind} {wanted}; last: {self.told[-3:]}")

    async def choose(self, partner: str, kind: str = "mixed") -> None:
        page = self.page
        await page.locator(f'input[name="partner"][value="{partner}"]').check()
        await page.locator('select[name="kind"]').select_option(kind)
        await page.get_by_role("button", name="To the table").click()

    async def ready(self) -> None:
        end = time.monotonic() + 30
        while not await self.page.evaluate("Boolean(coliftPlay.page && coliftPlay.page.may)"):
            if time.monotonic() > end:
                raise TimeoutError(await self.page.inner_text("#status"))
            await asyncio.sleep(0.05)

    async def grip(self) -> None:
        """Take hold of the table: put a finger on it, or click, which locks the mouse."""
        self.frames = {}
        if self.finger:
            box = await self.page.locator("#stage").bounding_box()
            assert box is not None
            self.x, self.y = box["x"] + 0.8 * box["width"], box["y"] + 0.75 * box["height"]
            self.scale = await self.page.evaluate("window.coliftPlay.page.stage.pixelsPerMetre")
            await self._move("touchStart", 0.0)
            return
        button = self.page.locator("#lift, #again").locator("visible=true").last
        box = await button.bounding_box()
        assert box is not None
        self.x, self.y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        self.scale = COUNTS_PER_METRE
        await self.page.mouse.click(self.x, self.y)

    async def move(self, hand: Hand, begin: float) -> dict[str, Any]:
        """Move the hand until the lift ends; ``begin`` is its first frame by the clock [s]."""
        after = len(self.told)
        pending = []
        gc.collect()
        gc.disable()  # A hand does not stop for a tenth of a second in the middle of its way.
        while not any(told["type"] in ("end", "void") for told in self.told[after:]):
            now = time.monotonic()
            pending.append(asyncio.ensure_future(self._move("touchMove", hand(now - begin))))
            await asyncio.sleep(max(EVERY_S - (time.monotonic() - now), 0))
        gc.enable()
        await asyncio.gather(*pending)
        if self.finger:
            await self._move("touchEnd", None)
        end: dict[str, Any] = next(t for t in self.told[after:] if t["type"] in ("end", "void"))
        return end

    async def follow(self, partner: Partner, delay: float, start: dict[str, Any]) -> dict[str, Any]:
        """Move the hand as a simulated second person, who sees the frames that arrive here.

        Parameters
        ----------
        partner
            The second person.
        delay
            Age of what is seen [s].
        start
            The room's message.
        """
        begin, made = start["at"] / 1000, [0.0]
        after = len(self.told)
        partner.reset(1)
        moving = asyncio.ensure_future(self.move(lambda time: _at(made, time), begin))
        while not moving.done():
            frame = len(made) - 1
            await asyncio.sleep(max(begin + frame * FRAME + 0.005 - time.monotonic(), 0))
            view = np.zeros(HumanObservation.size(STEP))
            age = round(delay / FRAME)
            own = [self._seen(frame - HISTORY + 1 + i)[1] for i in range(HISTORY)]
            other = [self._seen(frame - age - HISTORY + 1 + i)[0] for i in range(HISTORY)]
            view[HumanObservation.OWN_HEIGHT] = own
            view[HumanObservation.OTHER_END] = other
            view[HumanObservation.TARGET] = other[-1]
            made += partner.act(view).tolist()
        assert len(self.told) > after
        return await moving

    def _seen(self, frame: int) -> tuple[float, float]:
        """Return both ends in a frame; one that has not arrived is as the newest."""
        if frame <= 0 or not self.frames:
            return (0.0, 0.0)
        return self.frames.get(frame) or self.frames[max(self.frames)]

    async def _move(self, kind: str, height: float | None) -> None:
        place = None if height is None else {"x": self.x, "y": self.y - self.scale * height}
        if self.finger:
            points = [] if place is None else [place]
            await self._cdp.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        elif place is not None:
            await self._cdp.send("Input.dispatchMouseEvent", {"type": "mouseMoved", **place})


def _at(made: list[float], time: float) -> float:
    """Return the height at a time of the lift [s], of references at the ends of frames [m]."""
    place = min(max(time / FRAME, 0.0), len(made) - 1.0)
    low = min(int(place), len(made) - 2) if len(made) > 1 else 0
    high = min(low + 1, len(made) - 1)
    return made[low] + (made[high] - made[low]) * (place - low)
