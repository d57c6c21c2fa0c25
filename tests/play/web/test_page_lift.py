"""Lifts in a real browser, by finger, keys and mouse."""

import itertools

import pytest
from playwright.sync_api import expect

from ...browser import browser
from .browsing import (
    WAIT_MS,
    Hand,
    enter,
    table,
    wait_for,
    wait_for_height,
    wait_for_phase,
    wait_until_ready,
)
from .network import Network

pytestmark = pytest.mark.slow

HIGHEST = 0.38
"""The end of the hand's range [m], as in ``hand.js``."""

PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}


@pytest.fixture(scope="module")
def chromium():
    """A browser that locks the mouse."""
    with browser(locks=True) as opened:
        yield opened


def begin(page):
    """Wait for the first picture of a lift."""
    wait_for_phase(page, "lifting")
    wait_for(page, "coliftPlay.page.lifting.frames.last > 5")


def heights(hand):
    return [height for _, height in hand.samples]


def test_a_finger_moves_the_table_as_far_as_itself(open_page, url):
    page = open_page(**PHONE)
    hand = Hand(page)
    enter(page, url)
    box = page.locator("#stage").bounding_box()
    x, y = box["x"] + 200, box["y"] + 0.6 * box["height"]
    session = page.context.new_cdp_session(page)

    def touch(kind, *points):
        content = {"type": kind, "touchPoints": [{"x": x, "y": each} for each in points]}
        session.send("Input.dispatchTouchEvent", content)

    touch("touchStart", y)
    begin(page)
    for i in range(1, 41):
        touch("touchMove", y - i)
    shown = wait_for(page, "coliftPlay.page.stage.shown.human", lambda height: height > 0.08)
    scale = page.evaluate("coliftPlay.page.stage.pixelsPerMetre")
    wait_for_height(page, hand, 40 / scale)
    assert shown < 40 / scale + 0.02
    assert table(page)[1] < 0.05  # The robot holds still.
    assert page.evaluate("window.scrollY") == 0
    assert box["y"] + box["height"] <= PHONE["viewport"]["height"]
    touch("touchEnd")
    expect(page.locator("#status")).to_contain_text("does not count", timeout=WAIT_MS)
    wait_until_ready(page)


def test_keys_alone_are_enough(page, url):
    """From the address to a lift and out of it, without a pointer."""
    hand = Hand(page)
    page.goto(url)
    expect(page.get_by_role("button", name="To the table")).to_be_enabled()
    page.get_by_role("checkbox", name="I agree").focus()
    page.keyboard.press("Space")
    page.locator('input[name="partner"][value="hold"]').focus()
    page.keyboard.press("Space")
    page.keyboard.press("Enter")
    wait_until_ready(page)
    page.locator("#stage").focus()
    page.keyboard.press("Space")
    begin(page)
    page.keyboard.down("ArrowUp")
    wait_for(page, "coliftPlay.page.stage.shown.human", lambda height: height > 0.05)
    page.keyboard.up("ArrowUp")
    wait_for(page, "coliftPlay.page.hands.keys.steering.velocity", lambda velocity: velocity == 0)
    wait_for_height(page, hand, page.evaluate("coliftPlay.page.hands.keys.steering.height"))
    page.wait_for_timeout(100)
    moved = heights(hand)
    steps = [b - a for a, b in itertools.pairwise(moved)]
    assert max(steps) <= 0.00151  # 0.15 m/s, 100 times a second
    # On a slow page, the key is held until the hand is at the end of its range.
    free = itertools.takewhile(lambda height: height < HIGHEST - 0.0015, moved)
    jerks = [abs(b - a) for a, b in itertools.pairwise(b - a for a, b in itertools.pairwise(free))]
    assert max(jerks) <= 1.5e-4 + 1e-7
    assert steps[-1] == 0
    page.keyboard.press("Space")
    expect(page.locator("#status")).to_contain_text("let go", timeout=WAIT_MS)
    assert '{"type":"release"}' in hand.messages


@pytest.mark.parametrize("part", ["the button", "its label"])
def test_the_keys_work_as_soon_as_the_keyboard_is_chosen(page, url, part):
    """As the page says: Space takes hold, and the arrow keys move the table."""
    enter(page, url)
    page.locator("#input summary").click()
    button = page.get_by_label("keyboard")
    (button if part == "the button" else page.get_by_text("keyboard", exact=True)).click()
    page.keyboard.press("Space")
    begin(page)
    page.keyboard.down("ArrowUp")
    wait_for(page, "coliftPlay.page.stage.shown.human", lambda height: height > 0.03)
    assert button.is_checked()
    page.keyboard.press("Escape")
    expect(page.locator("#status")).to_contain_text("let go", timeout=WAIT_MS)


@pytest.mark.parametrize("key", ["Space", "Enter"])
def test_the_arrow_keys_go_through_the_inputs_and_a_key_chooses_one(page, url, key):
    enter(page, url)
    page.locator("#input summary").click()
    focused = "document.activeElement.value || document.activeElement.id"
    page.get_by_label("mouse").focus()
    for way, value in (
        ("Down", "touch"),
        ("Down", "keyboard"),
        ("Down", "gamepad"),
        ("Up", "keyboard"),
    ):
        page.keyboard.press(f"Arrow{way}")
        assert page.evaluate(focused) == value
        assert page.locator("[name=preset]:checked").input_value() == value
    page.keyboard.press(key)
    assert page.evaluate(focused) == "stage"
    wait_for_phase(page, "ready")
    page.keyboard.press("Space")
    begin(page)
    page.keyboard.press("Space")
    expect(page.locator("#status")).to_contain_text("let go", timeout=WAIT_MS)


def test_the_keys_work_at_once_with_a_keyboard_that_was_chosen_before(page, url):
    page.add_init_script(
        "localStorage.setItem('colift-play-input', JSON.stringify({ preset: 'keyboard' }))"
    )
    enter(page, url)
    page.keyboard.press("Space")
    begin(page)
    page.keyboard.press("Space")
    expect(page.locator("#status")).to_contain_text("let go", timeout=WAIT_MS)


def test_a_click_or_escape_lets_go_of_the_mouse(page, url):
    hand = Hand(page)
    enter(page, url)
    page.get_by_role("button", name="Lift", exact=True).click()
    begin(page)
    page.mouse.click(400, 400)
    expect(page.locator("#status")).to_contain_text("does not count", timeout=WAIT_MS)
    assert page.evaluate("document.pointerLockElement") is None
    assert '{"type":"release"}' in hand.messages


def test_a_mouse_that_cannot_be_locked_moves_the_table_by_a_held_button(page, url):
    hand = Hand(page)
    page.add_init_script("delete Element.prototype.requestPointerLock")
    enter(page, url)
    page.get_by_role("button", name="Lift", exact=True).click()
    expect(page.locator("#status")).to_contain_text("Hold its button down")
    page.mouse.move(300, 500)
    page.mouse.down()
    begin(page)
    page.mouse.move(300, 440, steps=10)
    wait_for(page, "coliftPlay.page.stage.shown.human", lambda height: height > 0.05)
    scale = page.evaluate("coliftPlay.page.stage.pixelsPerMetre")
    wait_for_height(page, hand, 60 / scale)
    page.mouse.up()
    expect(page.locator("#status")).to_contain_text("does not count", timeout=WAIT_MS)


def test_a_gamepad_moves_the_table_by_its_left_stick(page, url):
    hand = Hand(page)
    page.add_init_script("""
        window.pad = { connected: true, axes: [0, 0], buttons: [{ pressed: false }] };
        navigator.getGamepads = () => [null, window.pad];
    """)
    enter(page, url)
    page.locator("#input summary").click()
    page.get_by_label("gamepad").check()
    page.evaluate("pad.buttons[0].pressed = true")
    begin(page)
    page.evaluate("pad.axes[1] = -0.5")
    wait_for(page, "coliftPlay.page.stage.shown.human", lambda height: height > 0.03)
    steps = [b - a for a, b in itertools.pairwise(heights(hand))]
    assert max(steps) == pytest.approx(0.00075, abs=1e-7)
    assert any('"preset":"gamepad"' in message for message in hand.messages)


def test_the_delay_of_a_network_is_seen_from_hand_to_picture(page, url):
    """Without the buffers that hide it; measure.py compares the delays to a millisecond."""
    with Network(up=0.15, down=0.25).before(url) as through:
        enter(page, f"{through}/?playout=0&delay=0")
        page.locator("#stage").focus()
        page.keyboard.press("Space")
        begin(page)
        page.keyboard.down("ArrowUp")
        wait_for(page, "coliftPlay.page.lifting.delays.delays.length", lambda count: count > 30)
        delays = page.evaluate("coliftPlay.page.lifting.delays.delays")
        assert 400 < min(delays) < 4000
