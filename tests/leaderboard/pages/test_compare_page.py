"""Comparing policies, in a browser."""

import csv
import io
from dataclasses import replace
from statistics import fmean

import pytest
from colift.benchmark.statistics import Units, paired_difference
from colift.leaderboard.core.board import Board
from colift.leaderboard.replays.chosen import replays_of
from colift.leaderboard.storage.store import Store
from colift.leaderboard.views.compare import compare_page
from colift.leaderboard.views.lifts import public_lifts
from colift.leaderboard.views.page import Visit
from playwright.sync_api import expect

from .. import rows
from .boards import digest
from .conftest import running


def lifts_of(folder, played):
    """Return the public lifts of each policy of a board."""
    store = Store(folder)
    return {
        each.entry.name: public_lifts(store.bundle("2026", each.entry.submission))
        for each in played.entries
    }


def test_ticked_policies_are_compared_lift_by_lift(page, front, played, folder):
    page.goto(front)
    button = page.locator("#compare button")
    expect(button).to_be_disabled()
    for name in ("copy", "blend"):
        page.get_by_label(f"Compare {name}").check()
    expect(button).to_have_text("Compare 2")
    button.click()
    pair = page.locator("table.pairs tbody tr:visible")
    expect(pair).to_have_count(1)
    runs = lifts_of(folder, played)
    first, second = pair.locator("th").text_content().split(" minus ")
    units = Units.people((lift.behaviour, lift.subject) for lift in runs["copy"])
    errors = [[lift.rmse_mm for lift in runs[name]] for name in (first, second)]
    mean = paired_difference(*errors, units).mean
    shown = pair.locator("td b").first.text_content().replace("\N{MINUS SIGN}", "-")
    assert abs(float(shown) - mean) < 0.006
    expect(page.locator(".dots .series:visible")).to_have_count(2)
    page.get_by_text("All numbers", exact=True).click()
    whole = page.locator("table.compared tbody tr").first.locator("td[data-p]:visible")
    means = [fmean(lift.rmse_mm for lift in runs[name]) for name in ("copy", "blend")]
    assert [float(text) for text in whole.locator("b").all_text_contents()] == pytest.approx(
        sorted(means), abs=0.06
    )


@pytest.mark.slow
def test_four_are_enough_and_one_is_too_few(page, front):
    page.goto(front)
    boxes = page.locator("input[name=p]")
    for i in range(4):
        boxes.nth(i).check()
    page.locator("#compare button").click()
    expect(page.locator("table.pairs tbody tr:visible")).to_have_count(6)
    for select in page.locator("#choice select").all()[1:]:
        select.select_option("")
    page.get_by_role("button", name="Compare").click()
    expect(page.get_by_text("Choose at least two policies")).to_be_visible()
    assert page.url.count("p=") == 1


def test_it_begins_with_the_first_against_the_second(page, front, folder):
    board = Board.open(folder)
    names = [each.row.name for each in board.standings() if each.ranked]
    board.close()
    page.goto(front)
    page.get_by_role("link", name="Compare", exact=True).click()
    pair = page.locator("table.pairs tbody tr:visible th")
    expect(pair).to_have_text(f"{names[0]} minus {names[1]}")


def test_each_lift_is_drawn_and_can_be_had_as_csv(page, front, played, folder):
    board = Board.open(folder)
    names = [each.row.name for each in board.standings() if each.ranked][:2]
    board.close()
    page.goto(front)
    page.get_by_role("link", name="Compare", exact=True).click()
    expect(page.locator("#scatter use.lift title")).to_have_count(12)
    runs = lifts_of(folder, played)
    better = sum(
        a.rmse_mm < b.rmse_mm for a, b in zip(*(runs[name] for name in names), strict=True)
    )
    told = f"{names[0]} is more level than {names[1]} in {better}."
    assert page.locator("#scatter").get_attribute("aria-label").endswith(told)
    with page.expect_download() as saved:
        page.get_by_role("button", name="Single lifts as CSV").click()
    lifts = list(csv.DictReader(io.StringIO(saved.value.path().read_text())))
    for name in names:
        errors = [float(row[f"rmse_mm of {name}"]) for row in lifts]
        assert errors == [round(lift.rmse_mm, 3) for lift in runs[name]]


def test_the_same_lift_is_drawn_with_both_where_there_are_replays(page, url, folder):
    board = Board.open(folder)
    replays = {
        digest(name): {
            f"{each['behaviour']} {each['subject']} {each['seed']}": each
            for each in replays_of(board.bundle("2026", digest(name)), name)
        }
        for name in ("copy", "blend")
    }
    names = replays[digest("copy")].keys() & replays[digest("blend")].keys()
    chosen = [digest("copy"), digest("blend")]
    drawn = compare_page(Visit(board=board, chosen=chosen), "2026")["data"]["policies"]
    board.close()
    assert names
    for policy in drawn:
        assert policy["curves"].keys() == names
        for name, curve in policy["curves"].items():
            replay = replays[policy["p"]][name]
            last = sum(replay["robot"][: 5 * len(curve) - 4]) - sum(
                replay["human"][: 5 * len(curve) - 4]
            )
            assert curve[-1] == last
    page.goto(f"{url}/seasons/2026/compare?p={digest('copy')}&p={digest('blend')}")
    expect(page.get_by_label("The same lift").locator("option")).to_have_count(len(names))
    expect(page.locator("#curves polyline")).to_have_count(2)
    expect(page.locator("#same figcaption")).to_contain_text("copy solid, blend dotted")


@pytest.mark.slow
def test_the_scatter_has_the_size_of_a_picture_and_a_phone_shows_all_numbers_of_a_pair(page, front):
    page.goto(front)
    page.get_by_role("link", name="Compare", exact=True).click()
    scatter = page.locator("#scatter")
    expect(scatter).to_be_visible()
    assert scatter.bounding_box()["width"] <= 600
    page.set_viewport_size({"width": 390, "height": 844})
    pair = page.locator("table.pairs tbody tr:visible")
    for cell in page.locator("table.pairs tr:visible").locator("th, td").all():
        box = cell.bounding_box()
        assert 0 <= box["x"] < box["x"] + box["width"] <= 390
        assert cell.evaluate("cell => cell.scrollWidth <= cell.clientWidth")
    assert pair.locator("th").bounding_box()["height"] < 60
    expect(
        page.get_by_role("row").filter(has=page.get_by_role("rowheader", name="minus"))
    ).to_have_count(1)


def test_policies_of_one_name_can_be_told_apart_in_the_choice(page, tmp_path):
    board = Board.open(tmp_path / "board", "quick-v1")
    for name, mean in (("twin", 9.0), ("other twin", 10.0), ("blend", 11.0)):
        rows.add(board, name, mean, change=lambda row: replace(row, name=row.name.split()[-1]))
    submitters = {each.row.submission: each.submitter for each in board.standings()}
    board.close()
    with running(tmp_path / "board") as url:
        page.goto(f"{url}/seasons/1/compare")
        options = page.get_by_label("Policy 1").locator("option").all_text_contents()
    twins = [rows.digest(name) for name in ("twin", "other twin")]
    assert options[1:] == [
        *(f"twin by {submitters[each]}, {each[:8]}" for each in twins),
        "blend",
    ]


def test_nonsense_in_the_address_is_left_out(page, url, site):
    for address in (f"{url}/seasons/2026/compare", f"{site}/compare-2026.html"):
        page.goto(f"{address}?p=<script>&p=1'--&p={'f' * 64}")
        expect(page.get_by_text("Choose at least two policies")).to_be_visible()


def series(page):
    """Return colour, middle height and marks of each policy that is drawn."""
    return page.locator(".dots .series").evaluate_all(
        "all => all.filter((each) => !each.hasAttribute('hidden')).map((each) => ["
        "  getComputedStyle(each.querySelector('use')).fill,"
        "  each.querySelector('use').getAttribute('href'),"
        "  each.getBoundingClientRect().top,"
        "])"
    )


def test_the_dots_of_each_policy_have_a_colour_a_shape_and_a_place_of_their_own(page, front):
    page.goto(front)
    for name in ("copy", "blend", "hold"):
        page.get_by_label(f"Compare {name}").check()
    page.locator("#compare button").click()
    expect(page.locator("table.pairs tbody tr:visible")).to_have_count(3)
    drawn = series(page)
    assert len(drawn) == 3
    assert [len({each[i] for each in drawn}) for i in range(3)] == [3, 3, 3]
    picture = page.get_by_role("img", name="RMSE in mm with its 95 % interval, part by part")
    expect(picture).to_be_visible()
    for mark in picture.locator("use").all():
        assert mark.locator("title").count() == 1


def test_a_dot_is_where_the_scale_says(page, url, played, folder):
    page.goto(f"{url}/seasons/2026/compare?p={digest('copy')}&p={digest('blend')}")
    plot = page.locator("svg.dots").bounding_box()
    ticks = page.locator(".dots text[text-anchor=middle]")
    top = float(ticks.last.text_content().removesuffix(" mm"))
    runs = lifts_of(folder, played)
    first = page.locator(f".series[data-p='{digest('copy')}'] use").first.bounding_box()
    shown = top * (first["x"] + first["width"] / 2 - plot["x"]) / plot["width"]
    assert shown == pytest.approx(fmean(lift.rmse_mm for lift in runs["copy"]), abs=0.02 * top)


def test_markers_of_the_key_are_those_of_the_picture(page, front):
    page.goto(front)
    page.get_by_role("link", name="Compare", exact=True).click()
    keys = page.locator(".key li[data-p]:visible use")
    expect(keys).to_have_count(2)
    assert [each.get_attribute("href") for each in keys.all()] == [each[1] for each in series(page)]
