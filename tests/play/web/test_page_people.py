"""Two people at two pages, and somebody who watches."""

import json
import re

import pytest
from playwright.sync_api import expect

from .browsing import WAIT_MS, table, to_the_table, wait_for, wait_for_phase, wait_until_ready

pytestmark = pytest.mark.slow


class Heard:
    """Control messages that a page has received, and its frames."""

    def __init__(self, page):
        self.told, self.frames = [], 0
        page.on("websocket", lambda socket: socket.on("framereceived", self._take))

    def _take(self, payload):
        if isinstance(payload, bytes):
            self.frames += 1
        else:
            self.told.append(json.loads(payload))

    @property
    def kinds(self):
        return {told["type"] for told in self.told}


def grip(page):
    page.bring_to_front()
    page.locator("#stage").focus()
    page.keyboard.press("Space")


def drawn(page):
    """Return how many people the picture has, and whether it has a NAO."""
    stage = page.locator("#stage")
    people = stage.locator(".replay-person").locator("visible=true").count()
    return people, stage.locator(".replay-nao").first.is_visible()


def test_two_people_and_a_spectator(open_page, url):
    """The follower and the spectator see the table alone; the ends can be swapped."""
    host, guest, watcher = (open_page() for _ in range(3))
    heard = [Heard(page) for page in (host, guest, watcher)]
    host.goto(url)
    host.locator('input[name="partner"][value="person"]').check()
    to_the_table(host)
    expect(host.locator("#who")).to_have_text("The second person is not here yet.", timeout=WAIT_MS)
    assert not host.locator("#lift").is_visible()
    invitation = host.locator("#invite-link").input_value()
    watching = host.locator("#watch-link").input_value()
    assert re.fullmatch(re.escape(url) + r"/#p=[\w-]+\.[\w-]+", invitation)
    guest.goto(invitation)
    watcher.goto(watching)
    for page in (host, guest):
        wait_until_ready(page)
    expect(guest.locator("#place")).to_contain_text("left end, in orange, and follow")
    expect(host.locator("#place")).to_contain_text("right end, in blue, and lead")
    expect(watcher.locator("#place")).to_contain_text("You watch")
    assert not guest.locator("#change, #swap, #invitation").locator("visible=true").count()
    assert not watcher.locator("#lift").is_visible()
    assert [drawn(page) for page in (host, guest, watcher)] == 3 * [(2, False)]
    grip(host)
    expect(guest.locator("#who")).to_contain_text("one hand is closed", timeout=WAIT_MS)
    grip(guest)
    for page in (host, guest):
        wait_for_phase(page, "lifting")
    guest.keyboard.down("ArrowUp")
    wait_for(guest, "coliftPlay.page.stage.shown.robot", lambda height: height > 0.03)
    wait_for(host, "coliftPlay.page.lifting.frames.last", lambda frame: frame > 250)
    human, far = table(host)
    assert far > human + 0.03  # The leader has not moved; the follower pulls both ends up.
    assert table(watcher)[1] > 0.03
    assert "cue" in heard[0].kinds
    assert "cue" not in heard[1].kinds | heard[2].kinds
    assert "none" in guest.locator(".play-goal").get_attribute("class")
    expect(host.locator(".play-goal")).not_to_have_class(re.compile("none"), timeout=WAIT_MS)
    assert heard[2].frames > 100
    guest.keyboard.press("Space")
    for page in (host, guest, watcher):
        expect(page.locator("#status")).to_contain_text("does not count", timeout=WAIT_MS)
    host.get_by_role("button", name="Swap the ends").click()
    expect(guest.locator("#place")).to_contain_text("right end, in blue, and lead")
    expect(host.locator("#place")).to_contain_text("left end, in orange, and follow")
    guest.close()
    expect(host.locator("#who")).to_have_text("The second person is not here yet.", timeout=WAIT_MS)


def test_a_spectator_is_told_nothing_to_do(open_page, url):
    """Instructions and input are for those who hold the table."""
    host, watcher = open_page(), open_page()
    host.goto(url)
    host.locator('input[name="partner"][value="person"]').check()
    to_the_table(host)
    expect(host.locator("#status")).to_contain_text("send them the link", timeout=WAIT_MS)
    watcher.goto(host.locator("#watch-link").input_value())
    status = watcher.locator("#status")
    expect(status).to_have_text("The second person is not here yet.", timeout=WAIT_MS)
    for part in ("#how", "#input", "#change"):
        assert host.locator(part).is_visible()
        assert not watcher.locator(part).is_visible()
    assert watcher.locator("#stage").get_attribute("aria-describedby") is None
    host.get_by_role("button", name="Change the partner").click()
    host.locator('input[name="partner"][value="hold"]').check()
    to_the_table(host)
    expect(status).to_have_text("The next lift begins when they take hold.", timeout=WAIT_MS)
    wait_until_ready(host)
    grip(host)
    expect(status).to_have_text("They lift.", timeout=WAIT_MS)
    host.keyboard.press("Space")
    expect(status).to_have_text("This lift does not count: the hand let go.", timeout=WAIT_MS)
    watcher.evaluate("""
        coliftPlay.page.finished(
            { lift: 1, rmse_mm: 4.25, ghost_rmse_mm: 5.1, failure: null,
              session: { lifts: 10, rmse_mm: [4.25] } }, new coliftPlay.Delays())
    """)
    assert watcher.get_by_role("button", name="Watch it").is_visible()
    assert not watcher.locator("#next").locator("visible=true").count()
    assert not watcher.get_by_text("with your movement").is_visible()


def test_a_person_in_the_place_of_the_robot(open_page, url):
    host, guest = open_page(), open_page()
    host.goto(url)
    host.locator('input[name="partner"][value="person as robot"]').check()
    to_the_table(host)
    expect(host.locator("#invitation")).to_be_visible(timeout=WAIT_MS)
    guest.goto(host.locator("#invite-link").input_value())
    wait_until_ready(guest)
    expect(guest.locator("#place")).to_contain_text("You command the robot")
    assert [drawn(page) for page in (host, guest)] == 2 * [(1, True)]
