"""A whole lift by a real mouse, up to the score, the replay and the files."""

import asyncio
import itertools
import json
import math

import pytest
from colift.benchmark.bundle import read_bundle
from playwright.async_api import Page, async_playwright, expect

from ..browser import OPTIONS, chromium_path
from .browsing import WAIT_MS, Hand

EVERY_S = 0.004
RISE = 500
PATH = [RISE / 2 * (1 - math.cos(0.01 * math.pi * i)) for i in range(301)]
"""How far the mouse is above the button [px]: up and down, and up again."""

COUNT = 2e-4
"""Metres in a count."""

BUSY = "for (const end = performance.now() + 60; performance.now() < end; );"
"""Work of a page's own, during which the events of the mouse gather."""


def test_a_lift_by_mouse_from_the_click_to_the_replay(url, sessions):
    """Nothing of the mouse's way is lost, the table follows, and all is on disk in the end."""
    hand = asyncio.run(lifted(url))
    heights = [height for _, height in hand.samples]
    times = [time for time, _ in hand.samples]
    assert max(heights) == pytest.approx(COUNT * RISE, abs=COUNT)
    assert heights[-1] == pytest.approx(COUNT * RISE, abs=COUNT)
    assert all(a < b for a, b in itertools.pairwise(times))
    folder = next(sessions.glob("*/lifts/001-copy"))
    log = read_bundle(folder).recipe.suite().scenarios[0].human.log
    used = len(log.times)
    moved = max(i for i, height in enumerate(heights) if height != heights[-1])
    assert used > moved  # Only what a page sends after the end, the later the busier, is left out.
    assert log.heights.tolist() == pytest.approx(heights[:used])
    report = json.loads(folder.with_name("001-copy.times.json").read_text())
    delays = [each for part in report["seat_0"] for each in part["delays_ms"]]
    assert len(delays) > 20  # At ten pictures a second, too.
    assert 0 < min(delays) < 4000


async def lifted(url: str) -> Hand:
    """Lift once, and look at what the page shows afterwards; return what it has sent."""
    async with async_playwright() as playwright:
        browser = await playwright.chromium.launch(
            executable_path=chromium_path(playwright.chromium, locks=True), args=list(OPTIONS)
        )
        page = await browser.new_page(viewport={"width": 1280, "height": 800})
        hand = Hand(page)
        await page.goto(url)
        await page.locator('input[name="partner"][value="copy"]').check()
        await page.get_by_role("button", name="To the table").click()
        button = page.get_by_role("button", name="Lift", exact=True)
        await expect(button).to_be_visible(timeout=WAIT_MS)
        box = await button.bounding_box()
        await button.click()
        lifting = expect(page.locator("body"))
        await lifting.to_have_attribute("data-phase", "lifting", timeout=WAIT_MS)
        assert await page.evaluate("document.pointerLockElement.id") == "stage"
        while await page.evaluate("coliftPlay.page.lifting.frames.last") < 5:
            await asyncio.sleep(0.02)
        await move(page, box["y"] + box["height"] / 2)
        assert len(hand.samples) > hand.packets > 50  # What gathers is sent together, whole.
        await looked_at(page)
        await browser.close()
        return hand


async def move(page: Page, begins: float) -> None:
    """Move the mouse, waiting for no event as a real one does; keep the page busy once."""
    session = await page.context.new_cdp_session(page)
    loop, pending = asyncio.get_running_loop(), []
    begin = loop.time()
    for i, above in enumerate(PATH):
        await asyncio.sleep(max(begin + EVERY_S * i - loop.time(), 0))
        event = {"type": "mouseMoved", "x": 640, "y": begins - above}
        pending.append(asyncio.ensure_future(session.send("Input.dispatchMouseEvent", event)))
        if i == len(PATH) // 3:
            pending.append(asyncio.ensure_future(page.evaluate(BUSY)))
    await asyncio.gather(*pending)


async def looked_at(page: Page) -> None:
    """Check what is shown when the lift is over."""
    await expect(page.locator("#result")).to_be_visible(timeout=WAIT_MS)
    assert await page.evaluate("document.pointerLockElement") is None
    score = await page.locator("[data-part=score]").inner_text()
    await expect(page.locator("#status")).to_have_text(f"Level to {score} (RMSE).")
    await expect(page.locator("[data-part=delay]")).to_contain_text("ms old")
    standing = page.locator("[data-part=standing]")
    await expect(standing).to_contain_text("copy", timeout=WAIT_MS)
    await expect(page.locator("[data-part=policies] li")).to_have_count(3)
    await page.get_by_role("button", name="Watch it").click()
    slider = page.get_by_role("slider", name="Time in the lift")
    await expect(slider).to_be_visible(timeout=WAIT_MS)
    await expect(page.locator("#replay .replay-about")).to_contain_text("copy")
    await page.keyboard.press("Escape")
    await expect(page.get_by_role("button", name="Lift", exact=True)).to_be_visible()
