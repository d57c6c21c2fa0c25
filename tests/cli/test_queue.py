"""``colift queue`` as the keeper of a board meets it."""

import pytest
from colift.leaderboard.queue import Queue, WorkerQueue

from ..leaderboard.signed import write_signed

BOARD = ("--board", "board")


@pytest.fixture
def jobs(board, tmp_path):
    """A job that has failed, one under way, one that waits."""
    work, made = WorkerQueue(board), []
    for name in ("broken", "busy", "patient"):
        write_signed(tmp_path / name)
        (tmp_path / name / "policy.py").write_text(f"# {name}\n")
        made.append(Queue(board).enqueue(board.keep(tmp_path / name), "Ada"))
    work.fail(work.claim("one", made[0].id), "numpy [b]is missing[/b]", "attempt 1\nImportError")
    work.report(work.claim("one", made[1].id), "hidden run", 7, 40)
    return made


def test_the_list_says_how_far_each_is_or_why_it_has_no_row(colift, jobs):
    done = colift("queue", "list", *BOARD, COLUMNS="120")
    assert (done.returncode, done.stderr) == (0, "")
    for told in ("running: hidden run, 7 of 40", "numpy [b]is missing[/b]", "queued", "Ada"):
        assert told in done.stdout
    assert all(job.id[:8] in done.stdout for job in jobs)
    failed = colift("queue", "list", *BOARD, "--state", "failed").stdout
    assert jobs[0].id[:8] in failed
    assert jobs[1].id[:8] not in failed
    assert colift("queue", "list", *BOARD, "--state", "done").stdout == "No job is done.\n"


def test_the_log_is_printed(colift, jobs):
    assert colift("queue", "log", jobs[0].id[:8], *BOARD).stdout == "attempt 1\nImportError\n"
    assert colift("queue", "log", jobs[2].id, *BOARD).stdout == "No worker has begun this job.\n"


def test_a_job_that_has_ended_is_tried_again_and_that_is_told(colift, board, jobs):
    done = colift("queue", "retry", jobs[0].id[:8], "--why", "numpy was missing", *BOARD)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("broken is queued again\nNext: colift worker")
    assert Queue(board).job(jobs[0].id).state == "queued"
    assert [event.why for event in board.events(submission=jobs[0].submission)] == [
        "numpy was missing"
    ]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("list", "--state", "lost"), "--state 'lost' is none of queued, running"),
        (("log", "x"), "no job begins with 'x'; see: colift queue list"),
        (("log", ""), "3 jobs begin with ''"),
    ],
)
def test_what_is_wrong_is_said_in_a_line(colift, jobs, arguments, words):
    done = colift("queue", *arguments, *BOARD)
    assert done.returncode == 2
    assert words in done.stderr
    assert done.stderr.count("\n") == 1


def test_what_is_under_way_is_not_tried_again(colift, jobs):
    done = colift("queue", "retry", jobs[1].id, "--why", "impatience", *BOARD)
    assert done.returncode == 2
    assert "has ended without an entry" in done.stderr


def test_a_job_is_taken_out_of_the_queue_and_that_is_told(colift, board, jobs):
    """One that waits, and one that a worker has."""
    for job in jobs[1:]:
        done = colift("queue", "cancel", job.id[:8], "--why", "19 hours", *BOARD)
        assert (done.returncode, done.stdout) == (0, f"{job.name} is cancelled\n")
        assert Queue(board).job(job.id).state == "cancelled"
        (event,) = board.events(submission=job.submission)
        assert (event.kind, event.why) == ("cancellation", "19 hours")
    listed = colift("queue", "list", *BOARD, "--state", "cancelled", COLUMNS="120").stdout
    assert listed.count("cancelled: local: 19 hours") == 2
    done = colift("queue", "cancel", jobs[0].id, "--why", "again", *BOARD)
    assert done.returncode == 2
    assert "is in the queue" in done.stderr


def test_a_worker_says_how_it_keeps_policies_apart(colift, board):
    for name, told in (("auto", "isolation "), ("limits", "rows are not verified, not ranked")):
        done = colift("worker", *BOARD, "--once", "--isolation", name)
        assert done.returncode == 0, done.stderr
        assert told in done.stderr
    done = colift("worker", *BOARD, "--once", "--isolation", "walls")
    assert done.returncode == 2
    assert "unknown isolation 'walls'; known: bubblewrap, landlock, limits" in done.stderr
