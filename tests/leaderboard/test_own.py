"""The project's own policies in a season: queued and evaluated like anybody's."""

import dataclasses

import pytest
from colift.agents.errors import InputError
from colift.leaderboard.board import OWN
from colift.leaderboard.own import own_entrant, own_names
from colift.leaderboard.queue import Queue, Work
from colift.leaderboard.tokens import Tokens
from colift.leaderboard.worker import Worker


@pytest.fixture
def board(open_board, tiny_suite):
    return open_board(suite="tiny")


def test_an_own_policy_becomes_a_verified_row(board):
    queue = Queue(board)
    job = queue.enqueue_own(own_entrant("copy"))
    assert queue.enqueue_own(own_entrant("copy")).id == job.id
    done = Worker(Work(queue.board)).once()
    assert done.state == "done", done.reason
    (standing,) = board.standings()
    assert (standing.row.name, standing.submitter, standing.row.verified) == ("copy", OWN, True)


def test_a_policy_that_has_changed_since_it_was_queued_is_not_evaluated(board):
    queue = Queue(board)
    queue.enqueue_own(dataclasses.replace(own_entrant("copy"), digest="0" * 64))
    done = Worker(Work(queue.board)).once()
    assert done.state == "evaluator fault"
    assert "is not the one that was queued" in done.reason


def test_all_of_them_fit_into_the_queue_whatever_the_quota_of_others(board):
    queue = Queue(board)
    for name in own_names():
        queue.enqueue_own(own_entrant(name))
    assert {job.name for job in queue.jobs("queued")} == set(own_names())


def test_nobody_else_can_submit_under_their_name(board):
    with pytest.raises(InputError, match="not local or colift"):
        Tokens(board).add(OWN)
