"""A new board shows what the project ships; one that is there is left as it is."""

import dataclasses
from datetime import UTC, datetime

import pytest
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.core.board import Board
from colift.leaderboard.practice.season import SUITES
from colift.leaderboard.practice.season_import import PlayedSeason, open_with_practice
from colift.leaderboard.records.season import BoardEntry, PlayedEntry

from ..rows import digest, make_errors, make_row

SUITE = make_suite("quick-v1")
SEASON = "practice-quick-v1"


@pytest.fixture
def data(tmp_path, human_human):
    """A folder with a shipped season of one row."""
    at = datetime(2026, 1, 1, tzinfo=UTC)
    entry = BoardEntry(
        season=SEASON,
        submission=digest("blend"),
        name="blend",
        submitter="colift",
        at=at,
        row=make_row("blend", season=SEASON),
        refusal=None,
    )
    played = PlayedEntry(
        entry=entry, hidden_rmse_mm=make_errors(10.0), files={"results.json": b"{}"}
    )
    shipped = PlayedSeason(
        suite=SUITE.name,
        suite_digest=SUITE.digest,
        began_at=at,
        human_human=human_human,
        references={},
        played=(played,),
    )
    folder = tmp_path / "data"
    folder.mkdir()
    shipped.write(folder)
    return folder


@pytest.fixture
def opened(tmp_path, data, monkeypatch):
    """Return what opens a board stocked, and says which seasons and rows it has."""
    monkeypatch.delenv("COLIFT_DATABASE_URL", raising=False)

    def look():
        board = open_with_practice(tmp_path / "board", SUITE.name, data)
        try:
            return (
                [(each.name, each.current) for each in board.seasons()],
                [each.row.name for each in board.standings()],
            )
        finally:
            board.close()

    return look


def test_a_new_board_shows_the_shipped_rows_and_takes_submissions_beside_them(opened, caplog):
    expected = ([(SEASON, True)], ["blend"])
    assert opened() == expected
    assert opened() == expected
    assert caplog.messages == []


def test_a_new_board_ranks_the_shipped_suites(tmp_path, monkeypatch):
    monkeypatch.delenv("COLIFT_DATABASE_URL", raising=False)
    board = open_with_practice(tmp_path / "board")
    suites = {each.suite: board.standings(each.name) for each in board.seasons()}
    current = board.season_info().suite
    board.close()
    assert current == "robust-v1"
    assert suites.keys() == {*SUITES}
    for suite, rows in suites.items():
        assert rows[0].rank == (0 if suite == "paper-v1" else 1)  # Its five people are too few.
        assert all(each.ranked for each in rows)


def test_a_board_that_is_there_is_left_as_it_is(tmp_path, opened):
    Board.open(tmp_path / "board", SUITE.name).close()
    assert opened() == ([("1", True)], [])


def test_what_was_shipped_under_other_rules_is_not_shown_and_that_is_said_once(
    data, opened, caplog, monkeypatch
):
    shipped = PlayedSeason.read(SUITE.name, data)
    dataclasses.replace(shipped, suite_digest="0" * 16).write(data)
    monkeypatch.chdir(data.parent)
    assert opened() == ([("1", True)], [])
    assert opened() == ([("1", True)], [])
    (message,) = caplog.messages
    assert "the shipped practice rows are of another digest of quick-v1" in message
    assert "'colift practice --out data' makes them again" in message
    assert "\n" not in message


def test_nothing_shipped_is_nothing_shown(data, opened, caplog):
    for path in data.iterdir():
        path.unlink()
    assert opened() == ([("1", True)], [])
    assert caplog.messages == []
