"""A whole lift by a real mouse, up to the score, the replay and the files."""

import asyncio
import itertools
import json
import math

import pytest
from colift.benchmark.bundle import read_bundle
from playwright.async_api import Page, async_playwright, expect

from ...browser import OPTIONS, chromium_path
from .browsing import WAIT_MS, Hand

pytestmark = pytest.mark.slow

EVERY_S = 0.004
SPEED = 0.25
"""Of the hand, on its way to each goal [m/s]."""

TRIES = 3

COUNT = 2e-4
"""Metres in a count."""

BUSY = "for (const end = performance.now() + 60; performance.now() < end; );"
"""Work of a page's own, during which the events of the mouse gather."""

WATCHED = """() => {
    const lift = document.getElementById("lift");
    window.offers = [];
    new MutationObserver(() => {
        if (!lift.hidden) window.offers.push(coliftPlay.page.lifting.lift);
    }).observe(lift, { attributes: true, attributeFilter: ["hidden"] });
}"""
"""Notes the lift that is still shown, or null, whenever the button offers the next one."""


def test_a_lift_by_mouse_from_the_click_to_the_replay(url, sessions):
    """Nothing of the mouse's way is lost, the table follows, and all is on disk in the end."""
    hand, way = asyncio.run(lifted(url))
    heights = [height for _, height in hand.samples]
    times = [time for time, _ in hand.samples]
    assert max(heights) == pytest.approx(max(way), abs=COUNT + 1e-8)  # Sent in single precision.
    assert max(way) > 0.1
    assert heights[-1] == pytest.approx(way[-1], abs=COUNT)
    assert all(a < b for a, b in itertools.pairwise(times))
    folder = max(sessions.glob("*/lifts/*-copy"))  # The last is the one that counts.
    log = read_bundle(folder).recipe.suite().scenarios[0].human.log
    used = len(log.times)
    moved = max(i for i, height in enumerate(heights) if height != heights[-1])
    assert used > moved  # Only what a page sends after the end, the later the busier, is left out.
    assert log.heights.tolist() == pytest.approx(heights[:used])
    report = json.loads(folder.with_name(f"{folder.name}.times.json").read_text())
    delays = [each for part in report["seat_0"] for each in part["delays_ms"]]
    assert len(delays) > 20  # At ten pictures a second, too.
    assert 0 < min(delays) < 4000


async def lifted(url: str) -> tuple[Hand, list[float]]:
    """Lift until a lift counts, and look at what the page shows afterwards.

    A busy machine may be too late for a goal; then the page asks for another lift, as of a person.

    Returns
    -------
    tuple of Hand and list of float
        What the page has sent, and the heights of the mouse [m].
    """
    async with async_playwright() as playwright:
        browser = await playwright.chromium.launch(
            executable_path=chromium_path(playwright.chromium, locks=True), args=list(OPTIONS)
        )
        page = await browser.new_page(viewport={"width": 1280, "height": 800})
        hand = Hand(page)
        await page.goto(url)
        await page.locator('input[name="partner"][value="copy"]').check()
        await page.get_by_label("I agree").check()
        await page.get_by_role("button", name="To the table").click()
        await page.evaluate(WATCHED)
        for _ in range(TRIES):
            way = await one_lift(page, hand)
            ended = page.locator("#result, #lift").locator("visible=true")
            await expect(ended.first).to_be_visible(timeout=WAIT_MS)
            if await page.locator("#result").is_visible():
                break
        await looked_at(page)
        await browser.close()
        return hand, way


async def one_lift(page: Page, hand: Hand) -> list[float]:
    """Take hold and follow the goals; see :func:`follow`."""
    button = page.get_by_role("button", name="Lift", exact=True)
    await expect(button).to_be_visible(timeout=WAIT_MS)
    box = await button.bounding_box()
    # From the middle of a pixel, since the mouse counts whole ones.
    begins = math.floor(box["y"] + box["height"] / 2) + 0.5
    await button.click(position={"x": box["width"] / 2, "y": begins - box["y"]})
    lifting = expect(page.locator("body"))
    await lifting.to_have_attribute("data-phase", "lifting", timeout=WAIT_MS)
    assert await page.evaluate("document.pointerLockElement.id") == "stage"
    while await page.evaluate("coliftPlay.page.lifting.frames.last") < 5:
        await asyncio.sleep(0.02)
    way = await follow(page, begins)
    assert len(hand.samples) > hand.packets > 50  # What gathers is sent together, whole.
    return way


async def follow(page: Page, begins: float) -> list[float]:
    """Move the mouse to each goal, without waiting for events; keep the page busy once.

    Returns
    -------
    list of float
        The heights of the mouse [m].
    """
    session = await page.context.new_cdp_session(page)
    loop, pending, way = asyncio.get_running_loop(), [], [0.0]
    looking, due = asyncio.ensure_future(look(page)), loop.time()
    goal, busy = 0.0, True
    while goal is not None:
        due = max(due + EVERY_S, loop.time())
        await asyncio.sleep(due - loop.time())
        if looking.done():
            goal, looking = looking.result(), asyncio.ensure_future(look(page))
        most = SPEED * EVERY_S
        way.append(way[-1] + min(max((goal or 0.0) - way[-1], -most), most))
        event = {"type": "mouseMoved", "x": 640, "y": begins - way[-1] / COUNT}
        pending.append(asyncio.ensure_future(session.send("Input.dispatchMouseEvent", event)))
        if busy and way[-1] > 0.05:
            busy = False
            pending.append(asyncio.ensure_future(page.evaluate(BUSY)))
    await asyncio.gather(looking, *pending)
    return way


async def look(page: Page) -> float | None:
    """Return the goal that the page shows [m], 0 before there is one; None if the lift is over."""
    goal: float | None = await page.evaluate("""
        coliftPlay.page.lifting.hand.closed ? coliftPlay.page.stage.shown.goal ?? 0 : null
    """)
    return goal


async def looked_at(page: Page) -> None:
    """Check what is shown when the lift is over."""
    await expect(page.locator("#result")).to_be_visible(timeout=WAIT_MS)
    offers = await page.evaluate("window.offers")
    assert offers
    assert set(offers) == {None}  # The next lift is offered with the score, not before.
    assert await page.evaluate("document.pointerLockElement") is None
    score = await page.locator("[data-part=score]").inner_text()
    goals = await page.locator("[data-part=goals]").inner_text()
    await expect(page.locator("#status")).to_have_text(
        f"The ends differed by {score} (RMSE); the hand was {goals} from the goals."
    )
    await expect(page.locator("[data-part=delay]")).to_contain_text("ms old")
    standing = page.locator("[data-part=standing]")
    await expect(standing).to_contain_text("copy", timeout=WAIT_MS)
    await expect(page.locator("[data-part=policies] li")).to_have_count(3)
    await page.get_by_role("button", name="Watch it").click()
    slider = page.get_by_role("slider", name="Time in the lift")
    await expect(slider).to_be_visible(timeout=WAIT_MS)
    await expect(page.locator("#replay .replay-about")).to_contain_text("copy")
    await page.keyboard.press("Escape")
    await expect(page.get_by_role("button", name="Lift again")).to_be_visible()
    await expect(page.locator("#how")).to_be_hidden()
