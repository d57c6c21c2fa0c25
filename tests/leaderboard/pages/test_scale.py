"""A board of many rows: what a page sends, and what it takes to make it."""

import asyncio
import math
import re
import shutil
from contextlib import contextmanager
from statistics import fmean, geometric_mean

import httpx
import pytest
import sqlalchemy as sa
from colift.benchmark.bundle.files import RESULTS
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.decisions import Decisions
from colift.leaderboard.database.queries import record_entry
from colift.leaderboard.pages.links import Links
from colift.leaderboard.pages.rendering import render_page
from colift.leaderboard.pages.site import write_site
from colift.leaderboard.records.row import BoardRow
from colift.leaderboard.service.app import create_app
from colift.leaderboard.views.asked import ROWS, Asked
from colift.leaderboard.views.board import board_page
from colift.leaderboard.views.page import Visit
from colift.leaderboard.views.policy import policy_page
from playwright.sync_api import expect

from ..rows import digest, make_entry, make_errors
from .conftest import opened_page, running

pytestmark = pytest.mark.slow

MANY = 1000
FEW = 230


@contextmanager
def statements(board):
    """Yield a list that takes each SQL statement of a board."""
    told: list[str] = []

    def note(connection, cursor, statement, *rest):
        told.append(statement)

    sa.event.listen(board.database.engine, "before_cursor_execute", note)
    yield told
    sa.event.remove(board.database.engine, "before_cursor_execute", note)


@pytest.fixture
def rows_read(monkeypatch):
    """The number of rows that were read from the database, as a list of ones."""
    read, made = [], BoardRow.read

    def counted(content):
        read.append(1)
        return made(content)

    monkeypatch.setattr(BoardRow, "read", counted)
    return read


@pytest.fixture(scope="module")
def board(tmp_path_factory, played):
    board = Board.open(tmp_path_factory.mktemp("scale") / "board", "quick-v1")
    fill(board, 0, MANY, played.entries[0].files[RESULTS])
    yield board
    board.close()


def name(number):
    return f"policy-{number:04d}"


def fill(board, first, last, results):
    with board.database.writing() as connection:
        for number in range(first, last):
            mean = 8.0 + 0.02 * number
            record_entry(connection, make_entry(board, name(number), mean), make_errors(mean, 60))
            place = board.store.bundle("1", digest(name(number)))
            place.mkdir(parents=True)
            (place / RESULTS).write_bytes(results)


def page_of(board, **asked):
    return render_page("board.html", Links(), **board_page(board, None, Asked.read(**asked)))


def test_a_thousand_entries_take_no_more_queries_and_no_more_bytes_than_some_hundred(board, few):
    counts, sizes = [], []
    less = Board.open(few / "board")
    for each, rows in ((less, FEW), (board, MANY)):
        each.standings()
        with statements(each) as told:
            text = page_of(each)
            policy_page(Visit(board=each), "1", digest("policy-0003"))
        assert text.count("data-row=") == ROWS
        assert f"{rows} policies" in text
        counts.append(len(told))
        sizes.append(len(text))
    less.close()
    assert counts[0] == counts[1]
    assert sizes[1] < 1.05 * sizes[0] < 1_000_000


def test_each_row_is_on_one_page_of_the_table_in_every_order(board):
    for sort, down in (("rank", False), ("name", True), ("b2", False), ("at", False)):
        shown = []
        for first in range(0, MANY, ROWS):
            asked = Asked.read(sort="-" * down + sort, first=str(first))
            shown += [each.standing.row.name for each in board_page(board, None, asked)["rows"]]
        assert sorted(shown) == [name(number) for number in range(MANY)]
        if sort in ("rank", "name"):
            assert shown == sorted(shown, reverse=down)


def test_a_search_is_over_all_rows(board):
    view = board_page(board, None, Asked.read(q=" Policy-09 lovelace "))
    assert view["lines"].count == 100
    assert view["rows"][0].standing.row.name == "policy-0900"
    assert view["rows"][0].standing.rank == 901
    assert board_page(board, None, Asked.read(q="nobody"))["rows"] == ()


@pytest.mark.parametrize(
    "nonsense",
    [
        {"first": "-1"},
        {"first": "9" * 400},
        {"first": "\N{SUPERSCRIPT TWO}"},
        {"sort": "<b>"},
        {"sort": "--rmse"},
        {"behaviour": "x"},
        {"p": ["y"] * 30},
        {"q": "%" * 5000},
        {"columns": "z"},
    ],
)
def test_nonsense_in_the_address_is_a_page(board, nonsense):
    assert "</html>" in page_of(board, **nonsense)


def test_a_part_of_the_lifts_is_shown_and_sorted_by_without_a_script(folder, played):
    """As the page's script does it: see test_board_page."""
    shown = Board.open(folder)
    view = board_page(shown, "2026", Asked.read(behaviour="jerky", sort="rmse"))
    shown.close()
    found = [each.scores.rmse_mm.mean for each in view["rows"]]
    assert len(found) == len(played.entries)
    assert found == sorted(found)
    for each in view["rows"]:
        some = [s for s in each.strata if s.behaviour == "jerky"]
        assert len(some) == 3
        errors = [s.rmse_mm for s in some]
        ratios = [s.rmse_mm / s.human_human_rmse_mm for s in some]
        forces = [s.metrics["human_force_n"].mean for s in some]
        assert each.scores.rmse_mm.mean == pytest.approx(fmean(errors))
        assert each.scores.ratio == pytest.approx(geometric_mean(ratios))
        assert each.scores.metrics["human_force_n"].mean == pytest.approx(fmean(forces))
    assert not view["complete"]


def test_a_table_is_read_once_for_each_change(board, played, rows_read):
    """Entries that were read are not read again, whichever page asks."""
    board = Board.open(board.folder)
    board.standings()
    first = len(rows_read)
    assert first >= MANY
    for _ in range(5):
        page_of(board)
        page_of(board, q="policy-01", sort="-gap")
        board.standings()
    assert len(rows_read) == first
    fill(board, 2 * MANY, 2 * MANY + 1, played.entries[0].files[RESULTS])
    for _ in range(5):
        assert board_page(board)["total"] == MANY + 1
    assert len(rows_read) == first + 1
    Decisions(board).withdraw("1", digest(name(2 * MANY)), "Ada", "a copy")
    assert board_page(board)["total"] == MANY
    board.close()


def test_a_badge_a_page_of_a_policy_a_feed_and_the_method_read_no_table(board, rows_read):
    board.standings()
    mine = f"/seasons/1/policies/{digest('policy-0500')}"
    app = create_app(board.folder)

    async def answers():
        transport = httpx.ASGITransport(app)  # Without the thread that reads the tables.
        async with httpx.AsyncClient(transport=transport, base_url="http://board") as client:
            for path in (f"{mine}/badge.svg", mine, "/seasons/1/feed.atom", "/method", "/submit"):
                rows_read.clear()
                answer = await client.get(path)
                yield answer.status_code, len(rows_read)

    async def listed():
        return [each async for each in answers()]

    told = asyncio.run(listed())
    app.state.service.board.close()
    # A page of a policy also has its history, and its neighbours in the ranking.
    assert told == [(200, 1), (200, 4), (200, 100), (200, 1), (200, 1)]


def test_a_browser_without_scripts_searches_sorts_pages_and_compares(chromium, board):
    board.standings()
    with running(board.folder) as url:
        context = chromium.new_context(java_script_enabled=False)
        page = context.new_page()
        page.set_default_timeout(60_000)
        page.goto(url)
        shown = page.locator("tr[data-row] th a")
        expect(shown).to_have_text([name(number) for number in range(ROWS)])
        page.get_by_label("Compare policy-0003").check()
        page.get_by_role("button", name="The next 100").click()
        expect(shown.first).to_have_text(name(ROWS))
        page.get_by_role("searchbox").fill("policy-098")
        page.get_by_role("button", name="Show").click()
        found = [name(number) for number in range(980, 990)]
        expect(shown).to_have_text(found)
        by_name = page.get_by_role("columnheader").filter(has=page.locator("[data-sort=name]"))
        for order, expected in (("ascending", found), ("descending", found[::-1])):
            by_name.get_by_role("button").click()
            expect(by_name).to_have_attribute("aria-sort", order)
            expect(shown).to_have_text(expected)
        page.get_by_label("Compare policy-0985").check()
        expect(page.locator(".chosen")).to_contain_text("policy-0003")
        page.locator("#compare button").click()
        expect(page.locator("#choice option[selected]")).to_have_text(
            ["policy-0003", "policy-0985"]
        )
        context.close()


def test_with_scripts_a_choice_is_sent_at_once_and_ticks_travel(page, board):
    board.standings()
    with running(board.folder) as url:
        page.goto(url)
        page.get_by_label("Compare policy-0003").check()
        page.locator("#behaviour").select_option("jerky")
        expect(page.locator("#status")).to_contain_text("public lifts of jerky")
        assert "behaviour=jerky" in page.url
        assert "q=" not in page.url
        expect(page.get_by_label("Compare policy-0003")).to_be_checked()
        page.get_by_role("searchbox").fill("policy-0999")
        page.keyboard.press("Enter")
        expect(page.locator("tr[data-row]")).to_have_count(1)
        expect(page.locator(".chosen")).to_contain_text("policy-0003")
        page.get_by_label("Compare policy-0999").check()
        expect(page.locator("#compare button")).to_have_text("Compare 2")


@pytest.fixture(scope="module")
def few(tmp_path_factory, played):
    """A board of some hundred rows, and its site."""
    place = tmp_path_factory.mktemp("few")
    board = Board.open(place / "board", "quick-v1")
    fill(board, 0, FEW, played.entries[0].files[RESULTS])
    write_site(board, place / "site")
    board.close()
    return place


def test_a_site_has_pages_of_a_hundred_rows_and_loads_the_others_to_search_them(page, few, names):
    site = few / "site"
    counts = {
        path.name: path.read_text().count("data-row=")
        for path in (site / "index.html", *site.glob("rows-*"))
    }
    assert counts == {"index.html": ROWS, "rows-1-2.html": ROWS, "rows-1-3.html": FEW - 2 * ROWS}
    for path in site.glob("rows-*"):
        for address in re.findall(r'(?:href|src|action)="([^"#?]+)', path.read_text()):
            assert (site / address).is_file(), (path, address)
    page.goto((site / "index.html").as_uri())
    page.get_by_role("link", name="The next 100").click()
    expect(page.locator("tr[data-row] th a").first).to_have_text(name(ROWS))
    page.get_by_role("link", name="The 100 before").click()
    expect(page.get_by_label("Search")).to_be_hidden()
    page.get_by_role("button", name=f"Load all {FEW} rows").click()
    expect(page.get_by_label("Search")).to_be_visible()
    page.locator("button[data-sort=name]").click()
    page.locator("button[data-sort=name]").click()
    assert names(page)[0] == name(FEW - 1)
    page.get_by_label("Search").fill(name(FEW - 2))
    assert names(page) == [name(FEW - 2)]
    page.locator("#behaviour").select_option("jerky")
    expect(page.locator("tr[data-row]:visible .rmse")).not_to_have_text("\N{EN DASH}")
    page.get_by_label("Search").fill("")
    page.get_by_role("button", name=f"Show all {FEW}").click()
    assert len(names(page)) == FEW
    page.goto("about:blank")
    page.goto((site / "index.html").as_uri() + f"#q={name(FEW - 3)}")
    expect(page.locator("tr[data-row]:visible th a")).to_have_text(name(FEW - 3))


def test_a_site_takes_work_in_proportion_to_its_rows(tmp_path, played, rows_read):
    """Each row is read a few times, however many others there are."""
    reads, queries = [], []
    board = Board.open(tmp_path / "board", "quick-v1")
    for first, last in ((0, 20), (20, 40), (40, 80)):
        fill(board, first, last, played.entries[0].files[RESULTS])
        board.standings()
        rows_read.clear()
        with statements(board) as told:
            write_site(board, tmp_path / f"site-{last}")
        reads.append(len(rows_read))
        queries.append(len(told))
    board.close()
    for counts in (reads, queries):
        assert math.isclose(counts[2] - counts[1], 2 * (counts[1] - counts[0]), rel_tol=0.05)
    shutil.rmtree(tmp_path / "site-80")


def test_a_page_without_ranks_says_that_they_are_being_computed(tmp_path, played, chromium):
    board = Board.open(tmp_path / "board", "quick-v1")
    fill(board, 0, 3, played.entries[0].files[RESULTS])
    board.standings()
    fill(board, 3, 4, played.entries[0].files[RESULTS])
    with opened_page(chromium) as (page, _):
        page.set_content(page_of(board))
        expect(page.get_by_text("Ranks are being computed")).to_be_visible()
        assert page.locator("tr[data-row] td.rank").all_text_contents() == ["1", "2", "3", "\u2026"]
    board.standings()
    assert "being computed" not in page_of(board)
    board.close()
