"""The board's page, in a browser: from the service, and from the disk."""

import csv
import io
import json
from operator import truediv
from statistics import fmean, geometric_mean

import pytest
from colift.benchmark.bundle.files import RESULTS
from colift.benchmark.results.baselines import shipped_references
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.core.board import Board
from playwright.sync_api import expect

from .conftest import DESKTOP, running

pytestmark = pytest.mark.slow


def numbers(page, column):
    """Return what stands first in the cells of a column."""
    cells = page.locator(f"table.board tr[data-row]:visible td.{column}")
    shown = cells.evaluate_all("cells => cells.map((cell) => cell.firstChild.textContent)")
    return [float(text.replace("\N{MINUS SIGN}", "-")) for text in shown]


def test_rows_stand_in_the_order_of_the_ranking(page, front, names, folder):
    page.goto(front)
    board = Board.open(folder)
    assert names(page) == [each.row.name for each in board.standings() if each.ranked]
    groups = [str(each.rank or "\N{EN DASH}") for each in board.standings()]
    board.close()
    assert page.locator("tr[data-row] td.rank").all_text_contents() == groups
    assert numbers(page, "rmse") == sorted(numbers(page, "rmse"))


def test_a_click_sorts_by_a_column_and_another_one_the_other_way(page, front):
    page.goto(front)
    for column in ("ratio", "human_force_n", "step", "gap", "rmse"):
        button = page.locator(f"button[data-sort={column}]")
        button.click()
        assert numbers(page, column) == sorted(numbers(page, column))
        expect(button.locator("xpath=..")).to_have_attribute("aria-sort", "ascending")
        button.click()
        assert numbers(page, column) == sorted(numbers(page, column), reverse=True)
        expect(button.locator("xpath=..")).to_have_attribute("aria-sort", "descending")
        assert page.url.endswith(f"#sort=-{column}")


def test_who_has_no_smoothness_is_last_either_way(page, front, names):
    page.goto(front)
    for _ in range(2):
        page.locator("button[data-sort=sparc]").click()
        assert names(page)[-1] == "hold"


def test_a_filter_shows_the_means_of_the_public_lifts_of_that_part(page, front, played):
    page.goto(front)
    page.locator("#behaviour").select_option("jerky")
    for each in played.entries:
        groups = json.loads(each.files[RESULTS])["groups"]
        some = [group for group in groups if group["behaviour"] == "jerky"]
        row = page.locator("tbody tr").filter(has=page.get_by_label(f"Compare {each.entry.name}"))
        rmse, human_human = (
            [group[name]["mean"] for group in some] for name in ("rmse_mm", "human_human_rmse_mm")
        )
        assert row.locator(".rmse").text_content() == f"{fmean(rmse):.1f}"
        ratio = geometric_mean(map(truediv, rmse, human_human))
        assert row.locator(".ratio").text_content() == f"{ratio:.2f}"
    expect(page.locator("#status")).to_contain_text("public lifts of jerky")
    before = page.locator("tbody .dot").first.get_attribute("cx")
    page.locator("#behaviour").select_option("")
    assert page.locator("tbody .dot").first.get_attribute("cx") != before
    expect(page.locator("#status")).to_have_text("4 policies, scored on hidden lifts.")


def test_the_line_of_two_people_goes_where_they_are_on_the_part(page, front):
    page.goto(front)
    line = page.locator("#backdrop line.human-human")
    whole = float(line.get_attribute("x1").rstrip("%"))
    page.locator("#behaviour").select_option("jerky")  # Two people are no good at it either.
    assert float(line.get_attribute("x1").rstrip("%")) > 1.3 * whole


def test_search_finds_policies_and_authors(page, front, names):
    page.goto(front)
    page.get_by_label("Search").fill("GRACE co")
    assert names(page) == ["copy"]
    expect(page.locator("#status")).to_contain_text("1 of 4 policies")


def test_the_state_is_in_the_address(page, front, names):
    page.goto(front)
    page.locator("#behaviour").select_option("pause")
    page.get_by_label("Search").fill("ada")
    page.locator("button[data-sort=human_force_n]").click()
    shown, address = names(page), page.url
    rmse = page.locator("tbody .rmse").all_text_contents()
    page.goto("about:blank")
    page.goto(address)
    assert names(page) == shown
    assert page.locator("tbody .rmse").all_text_contents() == rmse
    assert page.locator("#behaviour").input_value() == "pause"
    page.evaluate("location.hash = '#behaviour=nonsense&sort=nonsense'")
    expect(page.locator("#status")).to_have_text("4 policies, scored on hidden lifts.")


def test_a_keyboard_is_enough(page, front, names):
    page.goto(front)
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.textContent") == "Skip to the content"
    page.locator("button[data-sort=name]").focus()
    page.keyboard.press("Enter")
    assert names(page) == sorted(names(page), key=str.lower)


def test_what_a_submission_says_is_text_and_nothing_else(page, front):
    page.goto(front)
    page.get_by_role("link", name="<b>sly</b>").first.click()
    expect(page.get_by_role("heading", level=1)).to_have_text("<b>sly</b>")
    expect(page.locator(".lead")).to_contain_text("<script>document.title")
    assert "stolen" not in page.title()


def test_another_season_is_a_frozen_tab_with_what_has_been_done_to_it(page, front, names):
    page.goto(front)
    page.get_by_role("link", name="Season 2025").click()
    expect(page.get_by_text("Season 2025 takes no submissions")).to_be_visible()
    assert "hold" not in names(page)
    gone = page.get_by_role("region", name="Out of the ranking")
    expect(gone).to_contain_text("hold")
    expect(page.get_by_role("region", name="Changes")).to_contain_text("it <i>never</i> moved")
    gone.get_by_role("link", name="hold").click()
    expect(page.get_by_text("This row is out of the ranking")).to_contain_text("by Ada")


def test_the_table_can_be_had_as_csv_and_json(page, url, folder):
    page.goto(url)
    with page.expect_download() as saved:
        page.get_by_role("link", name="CSV").click()
    rows = list(csv.DictReader(io.StringIO(saved.value.path().read_text())))
    board = Board.open(folder)
    assert [row["submission"] for row in rows] == [s.row.submission for s in board.standings()]
    board.close()
    with page.expect_download() as saved:
        page.get_by_role("link", name="JSON").click()
    table = json.loads(saved.value.path().read_text())
    assert [each["row"]["submission"] for each in table] == [row["submission"] for row in rows]


def test_licence_date_and_method_stand_in_the_table_and_are_found_and_sorted_by(
    page, front, names, played
):
    page.goto(front)
    row = page.locator("tr[data-row]").filter(has=page.get_by_label("Compare <b>sly</b>"))
    expect(row.locator(".name small")).to_contain_text("BSD-2-Clause")
    expect(row.locator(".name small")).to_contain_text("20 Nov 2026")
    page.get_by_label("Columns").select_option("about")
    assert page.url.endswith("#columns=about")
    expect(row.locator(".learned")).to_have_text("learned")
    assert (
        row.locator(".learned span").get_attribute("title") == "trained on: <i>recorded</i> lifts"
    )
    page.locator("button[data-sort=at]").click()
    entered = [each.entry for each in played.entries]
    newest = sorted(entered, key=lambda entry: entry.at, reverse=True)
    assert names(page) == [entry.name for entry in newest]
    page.get_by_label("Search").fill("learned bsd")
    assert names(page) == ["<b>sly</b>"]


def test_columns_by_behaviour_show_the_means_of_the_public_lifts(page, front, played):
    page.goto(front)
    expect(page.locator("td.behaviour:visible")).to_have_count(0)
    page.get_by_label("Columns").select_option("behaviours")
    heads = page.locator("th.behaviour button").all_inner_texts()
    assert [head.split("\n")[0] for head in heads] == ["smooth", "pause", "jerky", "changing goal"]
    for each in played.entries:
        groups = json.loads(each.files[RESULTS])["groups"]
        row = page.locator("tr[data-row]").filter(
            has=page.get_by_label(f"Compare {each.entry.name}")
        )
        errors: dict[str, list[float]] = {}
        for group in groups:
            errors.setdefault(group["behaviour"], []).append(group["rmse_mm"]["mean"])
        means = [f"{fmean(some):.1f}" for some in errors.values()]
        assert row.locator("td.behaviour").all_text_contents() == means
    page.locator("button[data-sort=b2]").click()
    assert numbers(page, "b2") == sorted(numbers(page, "b2"))


def test_two_people_and_the_references_stand_below_the_policies_and_follow_a_filter(
    page, front, folder
):
    page.goto(front)
    board = Board.open(folder)
    human_human, references = board.human_human(), board.references()
    board.close()
    rows = page.locator(".baselines tr")
    expect(rows).to_have_count(3)
    expect(rows.nth(0).locator(".rmse b")).to_have_text(f"{human_human.rmse_mm.mean:.1f}")
    expect(rows.nth(1).locator(".rmse b")).to_have_text(
        f"{references['best_known'].rmse_mm.mean:.1f}"
    )
    expect(rows.nth(2).locator(".rmse b")).to_have_text(f"{references['oracle'].rmse_mm.mean:.2f}")
    page.locator("#behaviour").select_option("jerky")
    jerky = shipped_references(make_suite("quick-v1"))["best_known"].part("jerky").mean
    expect(rows.nth(1).locator(".rmse")).to_have_text(f"{jerky:.1f}")
    page.locator("#behaviour").select_option("")
    expect(rows.nth(1).locator(".rmse b")).to_have_text(
        f"{references['best_known'].rmse_mm.mean:.1f}"
    )


def test_the_method_explains_the_references_that_have_been_played(page, front):
    page.goto(front)
    page.get_by_role("link", name="Method").click()
    told = page.locator("#references + dd")
    expect(told).to_contain_text("The best known (trained) sees what a policy sees")
    expect(told).to_contain_text("The oracle knows where the person is going")
    expect(told).to_contain_text("the same hidden lifts as the rows")


def test_the_first_rows_are_above_the_fold_and_the_heads_stand_at_one_height(page, front):
    page.goto(front)
    fourth = page.locator("tbody tr").nth(3).bounding_box()
    assert fourth["y"] + fourth["height"] < DESKTOP["height"]
    glance = page.locator(".glance").bounding_box()
    assert glance["y"] + glance["height"] <= page.locator("table.board").bounding_box()["y"]
    bottoms = page.locator("thead th:visible button").evaluate_all(
        "all => all.map((each) => Math.round(each.getBoundingClientRect().bottom))"
    )
    assert max(bottoms) - min(bottoms) <= 1


def test_on_a_telephone_a_row_is_two_lines_and_unfolds(page, front):
    page.set_viewport_size({"width": 390, "height": 844})
    page.goto(front)
    row = page.locator("tr[data-row]").first
    assert row.bounding_box()["height"] < 70
    expect(row.locator(".sparc")).to_be_hidden()
    expect(page.locator("thead .scale text").first).to_be_visible()
    button = row.get_by_role("button", name="All numbers of")
    button.click()
    expect(button).to_have_attribute("aria-expanded", "true")
    expect(row.locator(".sparc")).to_be_visible()
    expect(row.get_by_role("checkbox")).to_be_visible()
    expect(page.get_by_label("Sort by")).to_be_hidden()
    page.get_by_text("Filter and sort").click()
    expect(page.get_by_label("Sort by")).to_be_visible()


def test_the_picture_has_the_table_s_line_of_two_people_and_the_references(page, front):
    page.goto(front)
    table = page.locator(".baselines tr").first.locator(".rmse b").text_content()
    told = page.locator("svg.wide path.baseline title").text_content()
    assert told.startswith(f"two people: RMSE {table} mm")
    expect(page.locator("svg.wide path.reference")).to_have_count(2)


def test_the_picture_names_the_front(page, front):
    page.goto(front)
    told = page.locator("svg.wide").get_attribute("aria-label")
    assert told.startswith("4 policies")
    best = told.rpartition(": ")[2].rstrip(".").split(", ")
    assert page.locator("svg.wide text[font-weight][fill='var(--ink)']").all_text_contents() == best
    expect(page.locator("svg.wide path.best")).to_have_count(len(best))
    assert "hold" not in best


def test_the_beginning_of_a_season_is_told_once(page, tmp_path):
    Board.open(tmp_path / "board", "quick-v1").close()
    with running(tmp_path / "board") as url:
        page.goto(url)
        change = page.get_by_role("region", name="Changes").get_by_role("listitem")
        assert change.locator("> span").inner_text() == "Season begun by local"
