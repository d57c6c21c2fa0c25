"""The page of a policy, in a browser: from the service, and from the disk."""

import csv
import io
import itertools
import re

import pytest
from colift.benchmark.bundle.files import EPISODES
from colift.leaderboard.core.board import Board
from playwright.sync_api import expect

from .boards import digest


@pytest.fixture
def policy(page, front):
    """Return what opens the page of a policy."""

    def opened(name):
        page.goto(front)
        page.locator("tr[data-row]").get_by_role("link", name=name, exact=True).click()
        return page

    return opened


def test_licence_and_training_data_are_told(policy):
    page = policy("<b>sly</b>")
    facts = page.get_by_role("region", name="How it was run")
    expect(facts).to_contain_text("BSD-2-Clause")
    expect(facts).to_contain_text("<i>recorded</i> lifts")
    expect(page.get_by_text("Learned; trained on: <i>recorded</i> lifts")).to_be_visible()


def test_the_worst_lift_of_each_behaviour_leads_to_its_replay(policy, played):
    page = policy("copy")
    files = next(each.files for each in played.entries if each.entry.name == "copy")
    lifts = list(csv.DictReader(io.StringIO(files[EPISODES].decode())))
    jerky = max(float(each["rmse_mm"]) for each in lifts if each["behaviour"] == "jerky")
    worst = page.get_by_role("region", name="Its worst lifts")
    expect(worst.get_by_role("listitem")).to_have_count(4)
    shown = worst.get_by_role("listitem").filter(has_text="jerky")
    expect(shown).to_contain_text(f"{jerky:.1f} mm, two people ")
    seed = re.search(r"seed (\d+)", shown.text_content())[1]
    shown.get_by_role("link").click()
    expect(page.locator(".replay-about")).to_contain_text(f"seed {seed}")
    expect(page.get_by_role("button", name="worst")).to_have_attribute("aria-pressed", "true")


@pytest.mark.slow
def test_it_is_compared_with_its_neighbours_in_the_table(policy, front, folder):
    board = Board.open(folder)
    names = [each.row.name for each in board.standings() if each.ranked]
    board.close()
    page = policy(names[1])
    page.get_by_role("link", name=f"Compare with {names[2]}, after it").click()
    expect(page.locator("table.pairs tbody tr:visible th")).to_contain_text(names[2])
    expect(page.locator("table.pairs tbody tr:visible th")).to_contain_text(names[1])
    expect(policy(names[0]).get_by_role("link", name="before it")).to_have_count(0)


def test_it_can_be_cited_and_shown(policy, page):
    policy("<b>sly</b>")
    cite = page.get_by_label("BibTeX").text_content()
    assert f"@misc{{colift-{digest('<b>sly</b>')[:12]}," in cite
    assert "author = {{Ada Lovelace}}," in cite
    assert "title  = {<b>sly</b>}," in cite
    assert cite.count("{") == cite.count("}")
    badge = page.get_by_alt_text("The badge of this row")
    assert badge.evaluate("image => image.decode().then(() => image.naturalWidth > 60)")


def test_the_numbers_of_a_scale_stay_apart_and_on_a_phone(policy):
    page = policy("copy")
    page.set_viewport_size({"width": 390, "height": 844})
    boxes = [each.bounding_box() for each in page.locator(".parts .scale text").all()]
    assert len(boxes) > 2
    for left, right in itertools.pairwise(boxes):
        assert left["x"] + left["width"] < right["x"]
    assert boxes[-1]["x"] + boxes[-1]["width"] <= 374
