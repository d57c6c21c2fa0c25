"""Simulated people at a real browser: their hands are trusted events with times of their own.

Their eyes see the pictures that the page has drawn, when it has drawn them.
"""

import asyncio
import gc
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from colift.agents.agent import FRAME, HISTORY, HumanObservation
from colift.agents.humans import SecondPerson
from colift.agents.humans.felt import SUPPORT
from colift.benchmark.episode.turns import policy_seed
from colift.play.rooms.priority import ORDINARY, RELAY, take_turn
from numpy.typing import NDArray

from .devtools import Browser, Tab

EVERY_S = 0.004
"""Time between two events: four to a picture, so that the browser coalesces them."""

COUNTS_PER_METRE = 5000.0
"""Of a mouse, as the page takes them."""

STEP = 10
"""Frames for which a second person decides at a time."""

SOONER_S = 0.010
"""How much before its first frame a decision is made [s]: it takes a moment of this machine's time,
and depends on pictures that are older still (160 ms of the other end, 50 ms of the own)."""

SIZE = (900, 700)
"""Of the page [px]."""

EYES_AND_EARS = """
document.addEventListener("DOMContentLoaded", () => {
  const play = window.coliftPlay;
  const { take } = play.Connection.prototype;
  play.Connection.prototype.take = function (data) {
    if (typeof data === "string") window.heard(data);
    return take.call(this, data);
  };
  const { pose } = play.Stage.prototype;
  play.Stage.prototype.pose = function (human, robot) {
    pose.call(this, human, robot);
    const lifting = play.page && play.page.lifting;
    if (lifting && lifting.frames.running)
      window.seen(JSON.stringify([performance.now() + lifting.offset, human, robot]));
  };
});
"""
"""What a page tells of: control messages, and each picture with the room's time [ms]."""

RECENT = 100
"""Pictures that a decision may depend on."""

Heights = NDArray[np.float64]

Hand = Callable[[float], float]
"""Time of the lift [s] -> height of the hand above the grip [m]."""


class Driven:
    """A page whose person is simulated, with a locked mouse or with a finger.

    The room's clock is that of this machine.
    """

    def __init__(self, finger: bool = False) -> None:
        self.finger = finger
        self.told: list[dict[str, Any]] = []
        self.pictures: list[tuple[float, float, float]] = []
        """Room's time [s], and both ends [m] as they were drawn then."""

    @classmethod
    async def opened(cls, browser: Browser, url: str, finger: bool = False) -> "Driven":
        driven = cls(finger)
        driven.page = page = await browser.open(driven._take, SIZE)
        if finger:
            await page.send("Emulation.setTouchEmulationEnabled", enabled=True)
        for name in ("heard", "seen"):
            await page.send("Runtime.addBinding", name=name)
        await page.send("Page.addScriptToEvaluateOnNewDocument", source=EYES_AND_EARS)
        await page.send("Page.navigate", url=url)
        return driven

    page: Tab

    def _take(self, name: str, content: Any) -> None:
        if name == "heard":
            self.told.append(content)
        else:
            time, human, robot = content
            self.pictures.append((time / 1000, human, robot))

    async def until(self, kind: str, after: int = 0, seconds: float = 30.0, **wanted: Any) -> Any:
        """Return the first message of a kind that comes after so many messages."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for told in self.told[after:]:
                if told["type"] == kind and wanted.items() <= told.items():
                    return told
            await asyncio.sleep(0.01)
        raise TimeoutError(f"no {kind} {wanted}; last: {self.told[-3:]}")

    async def choose(self, partner: str) -> None:
        await self.page.wait_for("Boolean(window.coliftPlay && coliftPlay.page)")
        await self.page.evaluate(
            f"""document.querySelector('input[name="partner"][value="{partner}"]').click();
            document.querySelector('input[name="consent"]').click();
            [...document.querySelectorAll("button")].find(
              (each) => each.textContent.trim() === "To the table").click()"""
        )

    async def ready(self) -> None:
        await self.page.wait_for("Boolean(window.coliftPlay && coliftPlay.page?.may)")

    async def grip(self) -> None:
        """Take hold of the table: put a finger on it, or click, which locks the mouse."""
        self.pictures = []
        if self.finger:
            x, y, width, height = await self._box("#stage")
            self.x, self.y = x + 0.8 * width, y + 0.75 * height
            self.scale = await self.page.evaluate("coliftPlay.page.stage.pixelsPerMetre")
            await self._move("touchStart", 0.0)
            return
        x, y, width, height = await self._box("#lift")
        self.x, self.y = x + width / 2, y + height / 2
        self.scale = COUNTS_PER_METRE
        for kind, button in (
            ("mouseMoved", "none"),
            ("mousePressed", "left"),
            ("mouseReleased", "left"),
        ):
            await self.page.send(
                "Input.dispatchMouseEvent",
                type=kind,
                x=self.x,
                y=self.y,
                button=button,
                clickCount=int(button != "none"),
            )

    async def _box(self, selector: str) -> list[float]:
        """Return left, top, width and height of the last visible element [px]."""
        found: list[float] = await self.page.evaluate(
            f"""(() => {{
              const all = [...document.querySelectorAll({selector!r})];
              const found = all.filter((each) => each.checkVisibility()).at(-1);
              found.scrollIntoView({{ block: "nearest" }});
              const {{ x, y, width, height }} = found.getBoundingClientRect();
              return [x, y, width, height];
            }})()"""
        )
        return found

    async def move(self, hand: Hand, begin: float) -> dict[str, Any]:
        """Move the hand until the lift ends; ``begin`` is its first frame by the clock [s]."""
        after, pending, due = len(self.told), [], time.monotonic()
        gc.collect()
        # A hand does not stop in the middle of its way, neither for garbage nor for a page's work.
        gc.disable()
        take_turn(RELAY)
        while not any(told["type"] in ("end", "void") for told in self.told[after:]):
            pending.append(self._move("touchMove", hand(time.monotonic() - begin)))
            due = max(due + EVERY_S, time.monotonic())
            await asyncio.sleep(due - time.monotonic())
        take_turn(ORDINARY)
        gc.enable()
        await asyncio.gather(*pending)
        if self.finger:
            await self._move("touchEnd", None)
        end: dict[str, Any] = next(t for t in self.told[after:] if t["type"] in ("end", "void"))
        return end

    async def follow(
        self, partner: SecondPerson, delay: float, start: dict[str, Any]
    ) -> dict[str, Any]:
        """Move the hand as a simulated second person, who sees the pictures of this page.

        Parameters
        ----------
        partner
            The second person.
        delay
            Age of what is seen of the other end [s].
        start
            The room's message.
        """
        begin, made = start["at"] / 1000, [0.0]
        after = len(self.told)
        partner.reset(policy_seed())  # The same person as in the lift that is compared.
        moving = asyncio.ensure_future(self.move(lambda time: _at(made, time), begin))
        while not moving.done():
            now = begin + (len(made) - 1) * FRAME
            await asyncio.sleep(max(now - SOONER_S - time.monotonic(), 0))
            past = now + FRAME * np.arange(1 - HISTORY, 1)
            view = np.zeros(HumanObservation.size(STEP))
            view[HumanObservation.HAND_FORCE] = SUPPORT  # A page has no force.
            view[HumanObservation.OWN_HEIGHT] = self._seen(past)[1]
            view[HumanObservation.OTHER_END] = other = self._seen(past - delay)[0]
            view[HumanObservation.TARGET] = other[-1]
            made += partner.act(view).tolist()
        assert len(self.told) > after
        return await moving

    def _seen(self, times: Heights) -> Heights:
        """Return both ends [m] at times of the room's clock [s], as an eye has them of a display.

        A picture counts from when it was drawn, as in the delay that the page tells; between two of
        them, too short a time for an eye to see one stand, the movement goes on. There is no
        display here: one of 60 Hz would add half the time of a picture, 8 ms.
        """
        if not self.pictures:
            return np.zeros((2, len(times)))
        drawn, human, robot = np.array(self.pictures[-RECENT:]).T
        return np.array([np.interp(times, drawn, each) for each in (human, robot)])

    def _move(self, kind: str, height: float | None) -> asyncio.Future[Any]:
        """Let the browser have an event of this moment."""
        now = time.time()
        place = None if height is None else {"x": self.x, "y": self.y - self.scale * height}
        if self.finger:
            points = [] if place is None else [place]
            return self.page.send(
                "Input.dispatchTouchEvent", type=kind, touchPoints=points, timestamp=now
            )
        return self.page.send(
            "Input.dispatchMouseEvent", type="mouseMoved", timestamp=now, **(place or {})
        )


def _at(made: list[float], time: float) -> float:
    """Return the height at a time of the lift [s], of references at the ends of frames [m]."""
    place = min(max(time / FRAME, 0.0), len(made) - 1.0)
    low = min(int(place), len(made) - 2) if len(made) > 1 else 0
    high = min(low + 1, len(made) - 1)
    return made[low] + (made[high] - made[low]) * (place - low)
