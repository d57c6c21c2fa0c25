"""A board to back up."""

import pytest
from colift.leaderboard.core.decisions import Decisions
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.queue import Queue
from colift.leaderboard.queue.attendance import sign_in

from ..rows import add, digest


@pytest.fixture
def filled(board, write_submission):
    """Return a board with something in every table."""
    Tokens(board).add("ada")
    job = Queue(board).enqueue(board.keep(write_submission()), "ada")
    with board.database.writing() as connection:
        sign_in(connection, "host/machine/1/2", board.clock())
    board.store.add_to_log(job.id, "a line")
    board.store.add_to_private_log("1", job.id, "a secret line")
    for name in ("one", "two"):
        add(board, name, 10.0)
        bundle = board.store.bundle("1", digest(name))
        bundle.mkdir(parents=True)
        (bundle / "results.json").write_text(name)
    Decisions(board).withdraw("1", digest("one"), "Ada", "a mistake")
    board.new_season("2")
    board.standings("1")
    return board
