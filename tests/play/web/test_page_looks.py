"""How the page looks: for everybody, on a telephone and a desktop, light and dark."""

import re

import pytest
from colift.leaderboard.replays.html import SCRIPTS
from playwright.sync_api import expect

from ... import web
from ...browser import violations
from .browsing import (
    WAIT_MS,
    enter,
    to_the_table,
    wait_for,
    wait_for_phase,
    wait_until_ready,
)

pytestmark = pytest.mark.slow

SCREENS = {
    "desktop": {"viewport": {"width": 1280, "height": 800}},
    "phone": {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True},
}

ENDED = """
    const { page } = coliftPlay;
    page.result.show(
      { lift: 1, rmse_mm: 104.25, goal_error_mm: 12.34, ghost_rmse_mm: 5.1, failure: null,
        session: { lifts: 3, rmse_mm: [20.5, 9.25, 104.25] },
        compared: true, late: { frames: 2, worst_ms: 61, marked: true } },
      "copy", { median: 31, p95: 38.2 });
    page.result.compare({ lift: 1, human_human_mm: 101.5,
      policies: [{ name: "anticipate", rmse_mm: 3.1 }, { name: "copy", rmse_mm: 104.25 }] });
"""


@pytest.fixture(params=SCREENS)
def screen(request, open_page):
    return open_page(**SCREENS[request.param])


def looked_at(page):
    """Check a page as it is now: nothing for axe-core, and nothing is cut off."""
    page.emulate_media(color_scheme="light")
    assert violations(page) == []
    page.emulate_media(color_scheme="dark")
    assert violations(page, {"runOnly": ["color-contrast"]}) == []
    width = page.viewport_size["width"]
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def lines(page, part):
    """Return the number of lines that each text of a part takes."""
    return page.locator(part).evaluate_all("""
        (parts) => parts.map((part) => {
            const range = document.createRange();
            range.selectNodeContents(part);
            return new Set([...range.getClientRects()].map((box) => Math.round(box.top))).size;
        })
    """)


def test_no_choice_is_cut_off(screen, url):
    """A list is as wide as its longest choice would make it."""
    screen.goto(url)
    wait_for(screen, "Boolean(coliftPlay.page)")
    for name in ("kind", "latency"):
        wide, needed = screen.locator(f"select[name={name}]").evaluate("""
            (list) => {
                const free = list.cloneNode(true);
                free.style.cssText = "position: absolute; max-width: none; font-size: 1rem";
                list.after(free);
                const found = [list.offsetWidth, free.offsetWidth];
                free.remove();
                return found;
            }
        """)
        assert wide >= needed


def test_everybody_can_use_it(screen, url):
    """Before a lift, during one and after it; and what is needed in a lift is in the window."""
    screen.goto(url)
    wait_for(screen, "Boolean(coliftPlay.page)")
    looked_at(screen)
    enter(screen, url)
    screen.locator("#input summary").click()
    looked_at(screen)
    screen.evaluate("window.scrollTo(0, 0)")
    screen.locator("#stage").focus()
    screen.keyboard.press("Space")
    wait_for_phase(screen, "lifting")
    for part in ("#status", "#stage"):
        box = screen.locator(part).bounding_box()
        assert box["y"] >= 0
        assert box["y"] + box["height"] <= screen.viewport_size["height"]
    assert box["height"] > 0.6 * screen.viewport_size["height"]
    assert box["width"] > 0.6 * screen.viewport_size["width"]
    screen.keyboard.press("Space")
    expect(screen.locator("#status")).to_contain_text("does not count", timeout=WAIT_MS)
    screen.evaluate(ENDED)
    expect(screen.locator("[data-part=standing]")).to_have_text(
        "anticipate would have managed 3.1 mm with your movement (you and copy: 104.3 mm)."
    )
    looked_at(screen)
    assert set(lines(screen, "[data-part=score], [data-part=policies] b")) == {1}
    score = screen.locator("[data-part=score]").bounding_box()
    assert score["y"] + score["height"] <= screen.viewport_size["height"]


def test_the_page_says_plainly_what_it_is(page, url):
    page.goto(url)
    expect(page.locator("#choice")).to_contain_text("feel no force")
    expect(page.locator("#choice")).to_contain_text("teleoperation")
    assert page.locator("input[name=partner]").count() == 5


def test_nobody_is_recorded_who_has_not_agreed(page, url):
    page.goto(url)
    wait_for(page, "Boolean(coliftPlay.page)")
    expect(page.locator("#choice")).to_contain_text("is recorded on the computer")
    page.get_by_role("button", name="To the table").click()
    assert page.locator("body").get_attribute("data-view") == "choose"
    to_the_table(page)
    wait_until_ready(page)
    expect(page.locator("#how")).to_contain_text("By taking hold you agree")


def test_nothing_in_the_page_is_inline_or_from_elsewhere(url):
    text = web.get(url).text
    assert "</html>" in text
    assert "<style" not in text
    assert not re.search(r"<[^>]*\s(style|on\w+)=", text)
    scripts = re.findall(r'<script src="([^"]+)" defer></script>', text)
    assert len(scripts) == text.count("<script")
    assert [name.removeprefix("/static/") for name in scripts[: len(SCRIPTS)]] == list(SCRIPTS)
    for address in scripts:
        assert web.get(url + address).text.startswith('"use strict";')
