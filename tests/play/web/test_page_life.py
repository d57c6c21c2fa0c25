"""The life of a page: hidden, opened twice, loaded again, cut off, full house, wrong link."""

import re

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.play.web import keeper
from colift.play.web.keeper import PlayConfig
from playwright.sync_api import expect

from .browsing import (
    WAIT_MS,
    Hand,
    enter,
    start_patient_room,
    to_the_table,
    wait_for,
    wait_for_phase,
    wait_until_ready,
)
from .pages import playing

pytestmark = pytest.mark.slow

HIDE = """
    Object.defineProperty(document, "hidden", { value: true, configurable: true });
    document.dispatchEvent(new Event("visibilitychange"));
"""


def status(page):
    return expect(page.locator("#status"))


def grip(page):
    page.locator("#stage").focus()
    page.keyboard.press("Space")
    wait_for_phase(page, "lifting")


def test_a_page_that_is_hidden_lets_go(page, url):
    hand = Hand(page)
    enter(page, url)
    grip(page)
    page.evaluate(HIDE)
    status(page).to_contain_text("the page was hidden", timeout=WAIT_MS)
    assert '{"type":"hidden"}' in hand.messages
    wait_until_ready(page)


def test_a_second_tab_takes_over_and_the_first_can_take_back(page, open_page, url):
    enter(page, url, "copy")
    grip(page)
    second = open_page.watched(page.context.new_page())
    second.goto(page.url)
    status(page).to_contain_text("opened in another window", timeout=WAIT_MS)
    wait_until_ready(second)
    expect(second.locator("#partner")).to_have_text("You and copy")
    page.bring_to_front()
    page.get_by_role("button", name="Go on here").click()
    wait_until_ready(page)
    status(second).to_contain_text("opened in another window", timeout=WAIT_MS)


def test_a_page_that_is_loaded_again_goes_on(page, url):
    enter(page, url, "copy")
    grip(page)
    page.reload()
    wait_until_ready(page)
    expect(page.locator("#partner")).to_have_text("You and copy")
    grip(page)


def test_a_page_that_was_left_comes_back(page, url):
    """By the back button: from the browser's memory, or loaded again."""
    enter(page, url)
    page.goto(f"{url}/api/health")
    page.go_back()
    wait_until_ready(page)


@pytest.mark.parametrize("how", ["closed", "silent"])
def test_a_lost_connection_comes_back(page, url, how):
    enter(page, url)
    if how == "closed":
        grip(page)
    with page.expect_websocket(timeout=WAIT_MS):
        if how == "closed":
            page.evaluate("coliftPlay.page.connection.socket.close()")
        else:  # A cable that was pulled: nothing is heard any more.
            page.evaluate("coliftPlay.page.connection.heard = -60000")
    wait_until_ready(page)
    grip(page)


def test_a_grip_that_is_refused_opens_the_hand(page, url):
    enter(page, url)
    page.evaluate("coliftPlay.familyOf = () => 'x'.repeat(500)")
    page.locator("#stage").focus()
    page.keyboard.press("Space")
    expect(page.locator("#fault")).to_contain_text("at most 400 characters", timeout=WAIT_MS)
    wait_until_ready(page)


def test_a_sleeping_machine_lets_go(page, url):
    """A second passes for the page, and a minute for the clock on the wall."""
    enter(page, url)
    grip(page)
    page.evaluate("(() => { const now = Date.now; Date.now = () => now() + 60000; })()")
    status(page).to_contain_text("does not count", timeout=WAIT_MS)


def test_a_full_house_is_a_place_in_the_queue(open_page, sessions, monkeypatch):
    monkeypatch.setattr(keeper, "start_room", start_patient_room)
    policies = {"hold": PolicySpec(text="hold")}
    config = PlayConfig(folder=sessions, policies=policies, rooms=1)
    with playing(config) as url:
        first, second = open_page(), open_page()
        enter(first, url)
        second.goto(url)
        to_the_table(second)
        status(second).to_have_text(
            "You are number 1 in the queue. The only room is taken.", timeout=WAIT_MS
        )
        assert not second.locator("#how").is_visible()  # There is nothing to click yet.
        first.context.close()
        assert not second.locator("#lift").is_visible()
        second.context.close()  # Else it may ask for a place of a server that is gone.


def test_a_wrong_link_is_said_and_left_behind(page, url):
    page.goto(f"{url}/#s=20260101-0123456789ab.wrong")
    status(page).to_contain_text("There is no such session", timeout=WAIT_MS)
    for part in ("#how", "#input", "#change"):
        assert not page.locator(part).is_visible()
    page.get_by_role("button", name="New session").click()
    expect(page.get_by_role("button", name="To the table")).to_be_visible()


def test_a_server_that_is_away_is_said(page, url):
    page.goto(url)
    wait_for(page, "Boolean(coliftPlay.page)")
    page.route("**/api/sessions", lambda route: route.fulfill(status=429, json={"error": "Wait."}))
    to_the_table(page)
    status(page).to_have_text("Wait.")
    page.unroute("**/api/sessions")
    page.get_by_role("button", name="Try again").click()
    wait_until_ready(page)


def test_a_server_that_does_not_come_back_is_waited_for_for_a_stated_time(chromium, tmp_path):
    """A minute; then the page stops, and offers to load it again."""
    page = chromium.new_page()  # Browsers write down each connection that fails.
    page.clock.install()
    asked, wrong = [], []
    page.on("websocket", lambda socket: asked.append(socket.url))
    page.on("pageerror", lambda error: wrong.append(str(error)))
    with playing(PlayConfig(folder=tmp_path, policies={"hold": PolicySpec(text="hold")})) as url:
        enter(page, url)
        room = page.url
    status(page).to_contain_text("The connection was lost. Trying again for ", timeout=WAIT_MS)
    page.clock.fast_forward(30_000)
    status(page).to_have_text(
        re.compile(r"The connection was lost\. Trying again for (3\d|2\d) s …"), timeout=WAIT_MS
    )
    page.clock.fast_forward(31_000)
    status(page).to_have_text(
        "The server has not answered for 60 s. Reload the page when it is back.", timeout=WAIT_MS
    )
    tried = len(asked)
    assert tried >= 2
    page.clock.fast_forward(300_000)
    page.wait_for_timeout(300)
    assert len(asked) == tried
    assert not page.locator("#lift, #touch").locator("visible=true").count()
    assert page.get_by_role("button", name="Reload", exact=True).is_visible()
    assert page.url == room  # With the session's secret: a reload goes on there.
    assert wrong == []
    page.close()
