"""The label of two people on the board's scale, where they are bad: beside other headings."""

import dataclasses

import pytest
from colift.leaderboard.core.board import Board

from .conftest import running


@pytest.fixture(scope="module")
def url(played, tmp_path_factory):
    """A board whose two people are at the end of the scale."""
    worst = max(
        each.entry.row.hidden.rmse_mm.ci95[1]
        for each in played.entries
        if each.entry.name != "hold"  # It lies off the scale.
    )
    mm = 5 * (worst // 5) + 4.9
    lifts = len(played.human_human.rmse_mm)
    human_human = dataclasses.replace(played.human_human, values={"rmse_mm": (mm,) * lifts})
    folder = tmp_path_factory.mktemp("two") / "board"
    board = Board.open(folder, "quick-v1")
    board.import_season(dataclasses.replace(played, human_human=human_human))
    board.close()
    with running(folder) as address:
        yield address


def overlapping(page):
    """Return the headings that the label of two people touches."""
    return page.evaluate("""() => {
        const box = (each) => each.getBoundingClientRect();
        const label = box(document.querySelector(".board .scale text.human-human"));
        return [...document.querySelectorAll(".board thead th button")].filter((each) => {
            const range = document.createRange();
            range.selectNodeContents(each);
            const other = box(range);
            return label.left < other.right && other.left < label.right
                && label.top < other.bottom && other.top < label.bottom;
        }).map((each) => each.textContent);
    }""")


@pytest.mark.parametrize("width", [1400, 1280, 1000])
def test_the_label_of_two_people_stays_within_the_scale(page, url, width):
    page.set_viewport_size({"width": width, "height": 900})
    page.goto(url)
    label = page.locator(".board .scale text.human-human")
    assert float(label.get_attribute("x").rstrip("%")) > 90
    assert overlapping(page) == []


def test_a_filter_moves_the_label_and_its_side(page, url):
    page.goto(url)
    label = page.locator(".board .scale text.human-human")
    before = label.get_attribute("text-anchor"), label.get_attribute("dx")
    page.locator("#behaviour").select_option("smooth")
    assert float(label.get_attribute("x").rstrip("%")) < 85
    assert label.get_attribute("text-anchor") == "middle"
    page.locator("#behaviour").select_option("")
    assert (label.get_attribute("text-anchor"), label.get_attribute("dx")) == before
    assert overlapping(page) == []


def test_on_a_telephone_the_label_is_within_the_page(page, url):
    page.set_viewport_size({"width": 390, "height": 844})
    page.goto(url)
    box = page.locator(".board .scale text.human-human").bounding_box()
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= 390
