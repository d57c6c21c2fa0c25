"""What the tests of the queue share."""

import pytest
from colift.leaderboard.queue import (
    Queue,
    WorkerQueue,
)


@pytest.fixture
def queue(board):
    return Queue(board)


@pytest.fixture
def work(board):
    return WorkerQueue(board)


@pytest.fixture
def submit(board, queue, write_submission, tmp_path):
    """Return what puts a submission of its own into the queue."""

    def put(name="mine", submitter="Ada", into=None):
        folder = tmp_path / name
        if not folder.exists():
            write_submission(name=name, code=f"class Policy: ...  # {name}")
        return (into or queue).enqueue(board.keep(folder), submitter)

    return put
