"""A board of a thousand entries."""

import json
import shutil
from contextlib import contextmanager
from importlib.resources import files

import pytest
import sqlalchemy as sa
from colift.benchmark.bundle.files import RESULTS
from colift.leaderboard.board.board import Board
from colift.leaderboard.database.queries import record_entry
from colift.leaderboard.pages.links import ServiceLinks
from colift.leaderboard.pages.rendering import render_page
from colift.leaderboard.views.board import board_view
from colift.leaderboard.views.policy import policy_view

from ..rows import digest, make_entry, make_errors

MANY = 1000


@contextmanager
def statements(board):
    """Yield a list that takes each SQL statement of a board."""
    told: list[str] = []

    def note(connection, cursor, statement, *rest):
        told.append(statement)

    sa.event.listen(board.database.engine, "before_cursor_execute", note)
    yield told
    sa.event.remove(board.database.engine, "before_cursor_execute", note)


@pytest.fixture(scope="module")
def board(tmp_path_factory):
    board = Board.open(tmp_path_factory.mktemp("scale") / "board", "quick-v1")
    yield board
    board.close()


def fill(board, first, last, bundle):
    with board.database.writing() as connection:
        for number in range(first, last):
            name, mean = f"policy-{number:04d}", 8.0 + 0.02 * number
            record_entry(connection, make_entry(board, name, mean), make_errors(mean))
            place = board.store.bundle("1", digest(name))
            place.mkdir(parents=True)
            (place / RESULTS).hardlink_to(bundle / RESULTS)


def test_a_thousand_entries_take_no_more_queries_than_five(board, played, page, names, tmp_path):
    bundle = played.entries[0].bundle
    fill(board, 0, 5, bundle)
    counts = []
    for last in (5, MANY):
        fill(board, 5, last, bundle)
        with statements(board) as told:
            view = board_view(board)
            policy_view(board, "1", digest("policy-0003"))
        assert len(view.rows) == last
        counts.append(len(told))
    assert counts[0] == counts[1]
    text = render_page("board.html", ServiceLinks(), view=view)
    assert text.count("data-row=") == MANY
    assert len(json.dumps(view.data)) < 200_000

    # In the browser: a sort is over all rows, of which the first are laid out.
    shutil.copytree(files("colift.leaderboard") / "static", tmp_path / "static")
    (tmp_path / "index.html").write_text(text.replace("/static/", "static/"))
    page.goto((tmp_path / "index.html").as_uri())
    page.locator("button[data-sort=name]").click()
    page.locator("button[data-sort=name]").click()
    assert names(page)[0] == f"policy-{MANY - 1:04d}"
    assert len(names(page)) < MANY
    page.get_by_label("Search").fill("policy-0000")
    assert names(page) == ["policy-0000"]
    page.get_by_label("Search").fill("")
    page.get_by_role("button", name="Show all 1000").click()
    assert len(names(page)) == MANY
