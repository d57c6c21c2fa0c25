"""Comparing policies, in a browser."""

from colift.benchmark.statistics import paired_difference
from colift.leaderboard.views.lifts import public_lifts
from playwright.sync_api import expect


def test_ticked_policies_are_compared_lift_by_lift(page, front, played):
    page.goto(front)
    button = page.locator("#compare button")
    expect(button).to_be_disabled()
    for name in ("copy", "blend"):
        page.get_by_label(f"Compare {name}").check()
    expect(button).to_have_text("Compare 2")
    button.click()
    pair = page.locator("table.pairs tbody tr:visible")
    expect(pair).to_have_count(1)
    runs = {each.entry.name: public_lifts(each.bundle) for each in played.entries}
    first, second = pair.locator("th").text_content().split(" minus ")
    cells = [(lift.behaviour, lift.subject) for lift in runs["copy"]]
    errors = [[lift.rmse_mm for lift in runs[name]] for name in (first, second)]
    mean = paired_difference(*errors, cells).mean
    shown = pair.locator("td").first.text_content().replace("\N{MINUS SIGN}", "-")
    assert abs(float(shown) - mean) < 0.006
    expect(page.locator("table.compared tbody").first.locator("tr[data-p]:visible")).to_have_count(
        2
    )


def test_four_are_enough_and_one_is_too_few(page, front):
    page.goto(front)
    boxes = page.locator("input[name=p]")
    for i in range(4):
        boxes.nth(i).check()
    page.locator("#compare button").click()
    assert page.locator("table.pairs tbody tr:visible").count() == 6
    for select in page.locator("#choice select").all()[1:]:
        select.select_option("")
    page.get_by_role("button", name="Compare").click()
    expect(page.get_by_text("Choose at least two policies")).to_be_visible()
    assert page.url.count("p=") == 1


def test_nonsense_in_the_address_is_left_out(page, url, site):
    for address in (f"{url}/seasons/2026/compare", f"{site}/compare-2026.html"):
        page.goto(f"{address}?p=<script>&p=1'--&p={'f' * 64}")
        expect(page.get_by_text("Choose at least two policies")).to_be_visible()
