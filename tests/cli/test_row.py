"""``colift row`` as the maintainer of a board meets it."""

import pytest

from ..leaderboard.rows import add, digest

BOARD = ("--board", "board")


@pytest.fixture
def rows(board):
    """A board of three rows."""
    for name, mean in (("mine", 9.8), ("blend", 16.27), ("cheat", 1.2)):
        add(board, name, mean)
    return board


def sections(board):
    return {each.row.name: each.section for each in board.standings()}


@pytest.mark.parametrize(("act", "kind"), [("withdraw", "withdrawal"), ("remove", "removal")])
def test_a_row_leaves_the_ranking_and_comes_back(colift, rows, act, kind):
    done = colift("row", act, "cheat", "--why", "it read the [b]clock[/b]", "--by", "Ada", *BOARD)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("cheat is ")
    assert sections(rows) == {"mine": "ranking", "blend": "ranking", "cheat": "out"}
    (event,) = rows.events(submission=digest("cheat"))
    assert (event.kind, event.who, event.why) == (kind, "Ada", "it read the [b]clock[/b]")
    again = colift("row", act, digest("cheat")[:12], "--why", "again", *BOARD)
    assert again.returncode == 2
    assert "error: cheat in season 1 is already out of the ranking" in again.stderr
    back = colift("row", "reinstate", digest("cheat"), "--why", "it did not", *BOARD)
    assert back.stdout == "cheat is reinstated\n"
    assert sections(rows)["cheat"] == "ranking"
    assert [each.kind for each in rows.events(submission=digest("cheat"))] == [
        kind,
        "reinstatement",
    ]


@pytest.mark.parametrize(
    ("arguments", "code", "words"),
    [
        (("withdraw", "nobody"), 2, "season 1: no row matches 'nobody'; rows: "),
        (("remove", ""), 2, "season 1: no row matches ''; rows: "),
        (("reinstate", "mine"), 2, "mine in season 1 is not out of the ranking"),
        (("withdraw", "mine", "--season", "2030"), 2, "has no season '2030'; it has 1"),
        (("rescore", "mine", "--jobs", "1"), 1, "is not as it was submitted"),
    ],
)
def test_what_cannot_be_done_changes_nothing(colift, rows, arguments, code, words):
    before = rows.events()
    done = colift("row", *arguments, "--why", "x", *BOARD)
    assert (done.returncode, done.stdout) == (code, "")
    assert words in done.stderr
    assert "Traceback" not in done.stderr
    assert rows.events() == before
