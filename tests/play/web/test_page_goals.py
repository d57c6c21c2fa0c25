"""Goals on the page: who is told what and when, what does not count, what is replayed."""

import json
import re

import pytest
from colift.benchmark.real_lifts.session_folder import lift_folders
from playwright.sync_api import expect

from .browsing import WAIT_MS, enter, to_the_table, wait_for, wait_for_phase, wait_until_ready

pytestmark = pytest.mark.slow

TOLD = """
    window.told = [];
    const note = () => {
        const status = document.getElementById("status").textContent;
        const { page } = coliftPlay, { classList } = document.querySelector(".play-goal");
        const counts = document.querySelector(".play-count");
        const line = classList.contains("none") ? null : page.stage.shown.goal;
        const count = counts.classList.contains("none") ? null : Number(counts.textContent);
        const now = { status, line, count };
        if (JSON.stringify(now) !== JSON.stringify(told.at(-1))) told.push(now);
        requestAnimationFrame(note);
    };
    note();
"""
"""Notes what the page shows, picture by picture, whenever it changes."""

FOLLOW = """
    setInterval(() => {
        const { hands, lifting, stage } = coliftPlay.page, { steering } = hands.keys;
        if (!lifting.hand.started || !steering) return;
        const way = (stage.shown.goal ?? 0) - steering.height;
        steering.velocity = 0;
        steering.height += Math.min(Math.max(way, -0.003), 0.003);
    }, 10);
"""
"""A hand on the keys that goes to each goal at 0.3 m/s."""


def session_folder(page, sessions):
    return sessions / page.evaluate("coliftPlay.page.connection.place.session")


def lift(page):
    page.bring_to_front()
    page.locator("#stage").focus()
    page.keyboard.press("Space")


def over(page):
    wait_for_phase(page, "lifting")
    wait_for(page, "!coliftPlay.page.lifting.hand.closed")


def test_who_never_moves_has_no_lift_and_no_score(page, url, sessions):
    enter(page, url, "copy")
    lift(page)
    over(page)
    status = page.locator("#status")
    expect(status).to_contain_text("This lift does not count: the", timeout=WAIT_MS)
    expect(status).to_contain_text("line was not reached and held (the hand was ")
    expect(status).to_contain_text("Take hold to repeat it.")
    expect(page.locator("#result")).to_be_hidden()
    assert lift_folders(session_folder(page, sessions)) == []
    wait_until_ready(page)


def test_the_line_is_expected_and_the_goals_are_counted(page, url, sessions):
    """Before the line the page says to hold still, for how long; a lift to it has two numbers."""
    enter(page, url, "copy")
    page.evaluate(TOLD)
    page.evaluate(FOLLOW)
    lift(page)
    over(page)
    expect(page.locator("#result")).to_be_visible(timeout=WAIT_MS)
    told = page.evaluate("told")
    began = next(i for i, now in enumerate(told) if now["count"] is not None)
    shown = next(i for i, now in enumerate(told) if now["line"] is not None)
    waiting = told[began:shown]
    counts = [now["count"] for now in waiting if now["count"] is not None]
    assert counts in ([3, 2, 1], [2, 1])
    for now in waiting:
        if now["count"] is not None:
            assert now["status"] == f"Hold still: a line appears in {now['count']} s."
    assert all("Lift" not in now["status"] for now in told[:shown])
    assert told[shown]["status"] == "Lift to the line."
    assert told[shown]["count"] is None
    lines = [now for now in told[shown:] if now["line"] == 0]
    assert lines[0]["status"] == "Back to rest."
    goals = float(page.locator("[data-part=goals]").inner_text().removesuffix(" mm"))
    assert goals < 20
    (folder,) = lift_folders(session_folder(page, sessions))
    (error,) = json.loads((folder / "results.json").read_text())["goals"]["lifts"].values()
    assert error == pytest.approx(goals, abs=0.051)
    looked_at_replay(page)
    expect(page.get_by_role("button", name="Lift again")).to_be_visible()
    expect(page.locator("#how")).to_be_hidden()


def looked_at_replay(page):
    """Check that a replay shows the goals, and nothing that nobody did."""
    page.get_by_role("button", name="Watch it").click()
    replay = page.locator("#replay")
    expect(replay.locator(".replay-about")).to_contain_text(
        re.compile("live lift 1, with goals (up and down|with a stop|that change)"), timeout=WAIT_MS
    )
    for part in (".key-target", ".row-target dt"):
        expect(replay.locator(part)).to_have_text("goal")
    expect(replay.locator(".row-target dd")).to_have_text("none yet")
    events = replay.locator("text.event").all_text_contents()
    assert set(events) == {"a goal", "back to rest"}
    for word in ("intention", "waits", "lifts", "subject live"):
        assert word not in replay.inner_text()
    slider = page.get_by_role("slider", name="Time in the lift")
    slider.fill(slider.get_attribute("max"))
    expect(replay.locator(".row-target dd")).to_have_text("0 mm")
    page.keyboard.press("Escape")


def test_the_follower_is_told_what_a_follower_needs(open_page, url):
    host, guest, watcher = (open_page() for _ in range(3))
    host.goto(url)
    host.locator('input[name="partner"][value="person"]').check()
    to_the_table(host)
    expect(host.locator("#invitation")).to_be_visible(timeout=WAIT_MS)
    guest.goto(host.locator("#invite-link").input_value())
    watcher.goto(host.locator("#watch-link").input_value())
    for page in (host, guest):
        wait_until_ready(page)
        page.evaluate(TOLD)
    expect(host.locator(".leads")).to_be_visible()
    expect(host.locator(".follows")).to_be_hidden()
    expect(guest.locator(".follows")).to_be_visible()
    expect(guest.locator(".leads")).to_be_hidden()
    lift(host)
    expect(host.locator("#status")).to_have_text(
        "Hold still: the other hand is still open.", timeout=WAIT_MS
    )
    lift(guest)
    expect(guest.locator("#status")).to_have_text("Follow the table.", timeout=WAIT_MS)
    expect(watcher.locator("#status")).to_have_text("They lift.", timeout=WAIT_MS)
    over(guest)
    for page in (host, guest, watcher):
        expect(page.locator("#status")).to_contain_text("was not reached and held", timeout=WAIT_MS)
    for now in guest.evaluate("told"):
        assert now["count"] is None
        assert now["line"] is None
        assert "line appears" not in now["status"]
    assert any(now["count"] for now in host.evaluate("told"))


@pytest.mark.parametrize("goal", ["12.34", "null"])
def test_only_lifts_that_reached_their_goals_can_be_the_best(page, url, goal):
    """An earlier page kept scores without goal errors."""
    enter(page, url)
    page.evaluate("""
        const { session } = coliftPlay.page.connection.place;
        const old = { session, partner: "hold", rmse_mm: 0 };
        sessionStorage.setItem("colift-play-best", JSON.stringify(old));
    """)
    best = page.evaluate(f"""(() => {{
        const {{ result }} = coliftPlay.page;
        const end = {{ rmse_mm: 7.1, goal_error_mm: {goal}, failure: null }};
        return [result.best(end, "copy"), result.best({{ ...end, rmse_mm: 9 }}, "hold")];
    }})()""")
    kept = "Best of this session: 7.1 mm with copy, 12.3 mm from the goals."
    assert best == (["", kept] if goal != "null" else ["", ""])


def test_lifts_with_one_partner_are_listed_and_shown_when_all_are_done(page, url):
    enter(page, url)

    def told(*errors):
        return page.evaluate(
            """(rmse_mm) => {
                const { result } = coliftPlay.page;
                result.root.hidden = false;
                result.partner = "acquainted";
                result.together({ lifts: 3, rmse_mm });
                const part = result.part("together");
                return [part.hidden, part.open, part.innerText.split(/\\s*\\n\\s*/)];
            }""",
            errors,
        )

    assert told(12.0)[0]
    hidden, opened, lines = told(12.0, 9.0)
    assert (hidden, opened) == (False, False)
    assert lines == ["Lift by lift: 2 of 3 with acquainted"]
    hidden, opened, lines = told(12.0, 9.0, 6.06)
    assert (hidden, opened) == (False, True)
    assert lines == [
        "Lift by lift: 3 of 3 with acquainted",
        *("lift 1", "12.0 mm", "lift 2", "9.0 mm", "lift 3", "6.1 mm"),
    ]
    assert page.locator('[data-part="together-lifts"] .own').inner_text().startswith("lift 3")
