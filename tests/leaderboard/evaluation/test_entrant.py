"""The project's own policies in a season: queued and evaluated like anybody's."""

import dataclasses

import pytest
from colift.base.errors import InputError
from colift.base.registry import own_policies
from colift.leaderboard.core.board import BUILTIN
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.evaluation.entrant import LEARNED, builtin_entrant
from colift.leaderboard.queue import Queue, WorkerQueue
from colift.leaderboard.queue.worker import Worker


@pytest.fixture
def database():
    """No URL: the file in the board's folder."""


@pytest.fixture
def board(open_board, tiny_suite):
    return open_board(suite="tiny")


@pytest.mark.slow
def test_an_own_policy_becomes_a_verified_row(board):
    queue = Queue(board)
    job = queue.enqueue_builtin(builtin_entrant("copy"))
    assert queue.enqueue_builtin(builtin_entrant("copy")).id == job.id
    done = Worker(WorkerQueue(queue.board)).once()
    assert done.state == "done", done.reason
    (standing,) = board.standings()
    assert (standing.row.name, standing.submitter, standing.row.verified) == ("copy", BUILTIN, True)


def test_a_policy_that_has_changed_since_it_was_queued_is_not_evaluated(board):
    queue = Queue(board)
    queue.enqueue_builtin(dataclasses.replace(builtin_entrant("copy"), digest="0" * 64))
    done = Worker(WorkerQueue(queue.board)).once()
    assert done.state == "evaluator fault"
    assert "differs from the one that was queued" in done.reason


def test_all_of_them_fit_into_the_queue_whatever_the_quota_of_others(board):
    queue = Queue(board)
    for name in own_policies("level"):
        queue.enqueue_builtin(builtin_entrant(name))
    assert {job.name for job in queue.jobs("queued")} == set(own_policies("level"))


def test_what_was_learned_says_by_which_command_and_the_rest_from_nothing():
    told = {name: builtin_entrant(name).manifest.trained_on for name in own_policies("level")}
    assert "colift learn anticipate --lifts 1500" in told["anticipate"]
    assert told["blend"] == told["reactive"] != told["task_model"]
    assert {name for name, text in told.items() if text != "nothing"} == set(LEARNED)
    assert {builtin_entrant(name).manifest.licence for name in own_policies("level")} == {"MIT"}


def test_nobody_else_can_submit_under_their_name(board):
    with pytest.raises(InputError, match="not local or colift"):
        Tokens(board).add(BUILTIN)
