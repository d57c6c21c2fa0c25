"""The lift beside the headline of a table: it moves, stands, and is there without scripts."""

import io

import pytest
from colift.leaderboard.core.board import Board
from colift.leaderboard.replays.chosen import replays_of
from colift.leaderboard.replays.still import SIZE
from colift.leaderboard.service.app import create_app
from PIL import Image
from playwright.sync_api import expect

from ... import web
from ...serving import serving

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def first(folder):
    """The first policy of the table, with its replays, as a worker leaves them."""
    board = Board.open(folder)
    row = board.standings()[0].row
    made = replays_of(board.bundle("2026", row.submission), row.name)
    board.close()
    return row, next(each for each in made if each["which"] == "median")


def table(page):
    return page.locator(".glance .replay-table.real").get_attribute("transform")


def test_it_moves_until_it_is_paused(page, front, first):
    row, _ = first
    page.goto(front)
    glance = page.get_by_role("region", name="A lift")
    expect(glance).to_contain_text(f"A lift with {row.name}")
    shown = table(page)
    page.wait_for_function(
        "shown => document.querySelector('.glance .replay-table.real').getAttribute('transform')"
        " != shown",
        arg=shown,
    )
    glance.get_by_role("button", name="Pause").click()
    stands = table(page)
    page.wait_for_timeout(300)
    assert table(page) == stands
    glance.get_by_role("button", name="Play").click()
    expect(glance.get_by_role("button", name="Pause")).to_be_visible()


def test_who_wants_less_motion_sees_the_table_where_it_is_highest(page, front, first):
    _, replay = first
    page.emulate_media(reduced_motion="reduce")
    page.goto(front)
    expect(page.get_by_role("button", name="Play")).to_be_visible()
    heights = [sum(replay["human"][: i + 1]) for i in range(len(replay["human"]))]
    player = "document.querySelector('[data-glance]').coliftGlance"
    shown = page.evaluate(f"{player}.time")
    assert shown == pytest.approx((heights.index(max(heights)) + 1) * replay["frame_s"])
    before = table(page)
    page.wait_for_timeout(300)
    assert table(page) == before


def test_it_leads_to_all_lifts_of_that_policy(page, front, first):
    row, _ = first
    page.goto(front)
    page.get_by_role("link", name="Watch lifts").click()
    expect(page.get_by_role("heading", level=1)).to_have_text(
        f"{row.name} lifts a table with a person"
    )


def test_without_scripts_there_is_a_still(chromium, front, first):
    context = chromium.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(front)
    picture = page.get_by_role("img", name="The robot, the table and the person from the side")
    expect(picture).to_be_visible()
    assert picture.evaluate("picture => picture.naturalWidth") == SIZE[0]
    expect(page.get_by_role("button", name="Play")).to_have_count(0)
    context.close()


def test_the_still_has_an_address_of_its_own(url, first):
    answer = web.get(f"{url}/seasons/2026/still.png")
    assert answer.headers["content-type"] == "image/png"
    assert Image.open(io.BytesIO(answer.content)).size == SIZE
    assert web.get(f"{url}/seasons/9/still.png").status_code == 404


def test_a_link_elsewhere_shows_the_still(folder, first):
    with serving(create_app(folder, address="https://lab.example/course"), "/course") as url:
        text = web.get(f"{url}/").text
    place = "https://lab.example/course/seasons/2026/still.png"
    assert f'<meta property="og:image" content="{place}">' in text
