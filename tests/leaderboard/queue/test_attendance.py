"""Attendance: that nobody works for a board is known at once, by its own database."""

import os
import subprocess
import sys

import pytest
from colift.leaderboard.queue import LEASE
from colift.leaderboard.queue.attendance import KEPT, RENEWED
from colift.leaderboard.queue.jobs import this_worker

from ..rows import make_errors, outcome


def told(queue, job):
    return queue.unattended(queue.job(job.id))


def signatures(board):
    with board.database.reading() as connection:
        return dict(connection.exec_driver_sql("SELECT name, seen_at FROM workers").all())


def test_a_board_that_never_had_a_worker_says_so_at_once(submit, queue):
    assert told(queue, submit()) == (
        "Nobody evaluates at present: no worker of this board has been seen yet"
    )


def test_a_worker_that_waits_is_there_until_a_lease_after_its_last_sign(submit, queue, clock, work):
    assert work.claim("host/machine/1/2") is None
    job = submit()
    assert told(queue, job) is None
    clock.turn(seconds=LEASE.total_seconds() - 1)
    assert told(queue, job) is None
    clock.turn(seconds=2)
    assert told(queue, job) == (
        "Nobody evaluates at present: "
        "no worker of this board has been seen since 2027-03-01 12:00 UTC"
    )


def test_a_worker_that_waits_signs_every_few_seconds_and_not_at_each_query(board, clock, work):
    work.claim("one")
    first = signatures(board)
    clock.turn(seconds=RENEWED.total_seconds() - 1)
    work.claim("one")
    assert signatures(board) == first
    clock.turn(seconds=1)
    work.claim("one")
    assert signatures(board) != first


def test_a_worker_that_has_a_job_is_there_as_long_as_it_reports(submit, queue, clock, work):
    submit("a")
    job, waiting = work.claim("one"), submit("b")
    for _ in range(3):
        clock.turn(seconds=LEASE.total_seconds())
        work.report(job, "public run", 1)
    assert told(queue, job) is None
    assert told(queue, waiting) is None
    clock.turn(seconds=LEASE.total_seconds() + 1)
    for each in (job, waiting):
        assert told(queue, each).endswith("since 2027-03-01 12:01 UTC")


def test_of_a_job_that_has_ended_nothing_is_said(submit, queue, clock, work):
    submit()
    job = work.claim("one")
    work.finish(job, outcome(job), make_errors(10.0))
    clock.turn(days=1)
    assert told(queue, job) is None


def test_who_ends_says_so(submit, queue, work):
    job = submit()
    work.claim("host/machine/1/2", job="another")  # A submitter's own process, for its own job.
    assert told(queue, job).endswith("has been seen yet")
    work.release(work.claim("host/machine/1/2"))
    assert told(queue, job) is None
    work.leave("host/machine/1/2")
    assert "has been seen since" in told(queue, job)
    work.release(work.claim("host/machine/1/2"))
    assert told(queue, job) is None


@pytest.mark.slow
def test_a_worker_of_this_machine_that_was_killed_is_missed_at_once(submit, queue, work):
    ask = "from colift.leaderboard.queue.jobs import this_worker; print(this_worker())"
    told_by = subprocess.run(
        [sys.executable, "-c", ask], capture_output=True, text=True, check=True
    )
    work.claim(told_by.stdout.strip())
    assert "has been seen since" in told(queue, submit())
    work.release(work.claim(this_worker()))
    assert told(queue, submit()) is None


def test_old_signatures_go(board, clock, work):
    work.claim("one")
    clock.now += 2 * KEPT
    work.claim("two")
    assert set(signatures(board)) == {"two"}


@pytest.mark.parametrize("hours", [-2, 2])
def test_a_sign_from_a_clock_that_was_wrong_does_not_count_for_ever(
    submit, queue, clock, work, hours
):
    clock.turn(hours=hours)
    work.claim(f"host/machine/{os.getpid()}/2")
    clock.turn(hours=-hours)
    assert "Nobody evaluates" in told(queue, submit())
