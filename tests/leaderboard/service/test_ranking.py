"""Ranks are computed while others read: nobody waits for them."""

import threading
import time

import pytest
from colift.leaderboard.core import ranks
from colift.leaderboard.core.decisions import Decisions

from ... import web
from ..rows import add, digest

LONGEST_S = 60.0


@pytest.fixture
def slow_ranks(monkeypatch):
    """Return two events: that ranks are being computed, and that they may be finished."""
    begun, go = threading.Event(), threading.Event()
    tested = ranks.all_pairs

    def waiting(errors, people):
        begun.set()
        assert go.wait(LONGEST_S)
        return tested(errors, people)

    monkeypatch.setattr(ranks, "all_pairs", waiting)
    yield begun, go
    go.set()


def rows(url):
    found = web.get(f"{url}/api/v1/standings").json()
    return [(each["row"]["name"], each["rank"], each["pending"]) for each in found]


def test_readers_have_the_last_ranks_until_the_next_are_there(
    tmp_path, serving, opening, slow_ranks
):
    begun, go = slow_ranks
    go.set()
    with opening(tmp_path / "board") as board:
        add(board, "a", 10.0)
        add(board, "c", 20.0)
        board.standings()
        go.clear()
        begun.clear()
        with serving(tmp_path / "board") as url:
            add(board, "b", 15.0)
            assert begun.wait(LONGEST_S)  # The service computes what nobody else does.
            told = rows(url)
            assert told == [("a", 1, False), ("b", 0, True), ("c", 2, False)]
            for path in (
                "/",
                "/method",
                "/api/v1/standings.csv",
                "/seasons/1/feed.atom",
                "/seasons/1/behaviours",
                "/seasons/1/compare",
                f"/seasons/1/policies/{digest('b')}",
                f"/seasons/1/policies/{digest('c')}/badge.svg",
            ):
                assert web.get(url + path).status_code == 200
            assert "Ranks are being computed" in web.get(url).text
            badge = web.get(f"{url}/seasons/1/policies/{digest('b')}/badge.svg").text
            assert "being ranked" in badge
            go.set()
            end = time.monotonic() + LONGEST_S
            while told[1] != ("b", 2, False) and time.monotonic() < end:
                told = rows(url)
            assert told == [("a", 1, False), ("b", 2, False), ("c", 3, False)]
            assert "Ranks are being computed" not in web.get(url).text


def test_ranks_are_computed_by_one_at_a_time(tmp_path, opening, slow_ranks):
    begun, go = slow_ranks
    calls = []
    with opening(tmp_path / "board") as board, opening(tmp_path / "board") as other:
        add(board, "a", 10.0)
        add(board, "b", 20.0)
        threads = [
            threading.Thread(target=lambda each=each: calls.append(each.standings()))
            for each in (board, other, board)
        ]
        for thread in threads:
            thread.start()
        assert begun.wait(LONGEST_S)
        begun.clear()
        go.set()
        for thread in threads:
            thread.join()
    assert not begun.is_set()
    assert calls[0] == calls[1] == calls[2]


def test_a_row_that_was_rescored_waits_for_its_new_rank(tmp_path, opening):
    from ..rows import make_errors, rescored

    with opening(tmp_path / "board") as board:
        entry = add(board, "a", 10.0)
        add(board, "b", 15.0)
        board.standings()
        right = rescored(entry.row, 18.0)
        Decisions(board).rescore("1", right, make_errors(18.0), "Ada", "a mistake")
        table = board.tables.read("1")
        told = [(each.row.name, each.rank, each.pending) for each in table.rows]
        assert not table.current
        assert told == [("b", 2, False), ("a", 0, True)]
        told = [(each.row.name, each.rank, each.pending) for each in board.standings()]
        assert told == [("b", 1, False), ("a", 2, False)]


def test_ranks_of_an_older_colift_are_computed_again(tmp_path, opening):
    import sqlalchemy as sa
    from colift.leaderboard.database.schema import rank_groups

    with opening(tmp_path / "board") as board:
        add(board, "a", 10.0)
        old = {"season": "1", "fingerprint": "f" * 64, "groups": [[1, [[digest("a")]]]]}
        with board.database.writing() as connection:
            connection.execute(sa.insert(rank_groups).values(**old))
        assert board.tables.read("1").rows[0].pending
        assert board.standings()[0].rank == 1
