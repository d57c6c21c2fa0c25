"""Leases: a job goes on elsewhere if its worker is silent or gone, whatever the clocks say."""

import os
import subprocess
import sys
import time
from datetime import UTC, datetime, timedelta

import pytest
from colift.leaderboard.core.board import Board
from colift.leaderboard.queue import LEASE, LostError, Queue, WorkerQueue
from colift.leaderboard.queue.jobs import is_gone, this_worker

from ..rows import make_errors, outcome

SKEW = timedelta(seconds=2)
"""PostgreSQL and this process read one clock, SQLite to a millisecond."""


def test_a_worker_says_how_far_it_is(submit, queue, clock, work):
    submit()
    job = work.claim("one")
    clock.turn(seconds=3)
    work.report(job, "hidden run", 30, 70)
    now = queue.job(job.id)
    assert (now.state, now.stage, now.done, now.total) == ("running", "hidden run", 30, 70)
    assert now.heartbeat_at == clock.now
    work.report(job, "verification", 60)
    assert (queue.job(job.id).state, queue.job(job.id).total) == ("verifying", 70)


def test_a_job_whose_worker_is_silent_for_a_lease_is_anothers(submit, queue, clock, work):
    submit()
    first = work.claim("one")
    clock.turn(seconds=LEASE.total_seconds() - 1)
    work.report(first, "public run", 1)
    clock.now += LEASE
    assert work.claim("two") is None
    clock.turn(seconds=1)
    second = work.claim("two")
    assert (second.id, second.worker, second.attempt, second.done) == (first.id, "two", 2, 0)
    row = outcome(first)
    for late in (
        lambda: work.report(first, "audit", 2),
        lambda: work.finish(first, row, make_errors(10.0)),
        lambda: work.fail(first, "no"),
        lambda: work.fault(first, "no"),
        lambda: work.release(first),
    ):
        with pytest.raises(LostError):
            late()
    assert queue.job(first.id) == second
    work.finish(second, row, make_errors(10.0))
    assert queue.job(first.id).state == "done"


@pytest.mark.slow
def test_a_worker_of_this_machine_that_is_gone_is_not_waited_for(submit, queue, work):
    submit()
    ask = "from colift.leaderboard.queue.jobs import this_worker; print(this_worker())"
    told = subprocess.run([sys.executable, "-c", ask], capture_output=True, text=True, check=True)
    gone = told.stdout.strip()
    assert is_gone(gone)
    assert not is_gone(this_worker())
    first = work.claim(gone)
    second = work.claim(this_worker())
    assert (second.id, second.attempt) == (first.id, 2)
    assert work.claim("another") is None


@pytest.mark.parametrize(
    "name",
    ["w", "host/machine/12/34", "", pytest.param(f"a/b/{os.getpid()}/c", id="a process of ours")],
)
def test_of_a_worker_elsewhere_only_its_silence_tells(name):
    assert not is_gone(name)


def test_a_job_that_was_given_back_waits_again(submit, queue, work):
    submit()
    job = work.claim("one")
    work.release(job)
    assert queue.job(job.id).state == "queued"
    assert work.claim("two").attempt == 2


def test_a_clock_that_was_ahead_keeps_no_job_from_being_taken(submit, queue, clock, work):
    """A day ahead at the submission, at the claim, or when a fault is put off."""
    clock.turn(days=1)
    submit("a")
    clock.turn(days=-1)
    first = work.claim("one")
    assert first.name == "a"
    clock.turn(days=1)
    work.report(first, "public run", 1)
    clock.turn(days=-1)
    second = work.claim("two")
    assert (second.id, second.attempt) == (first.id, 2)
    clock.turn(days=1)
    for end in (work.fault, work.postpone):
        end(queue.job(first.id), "no disk")
        clock.turn(days=-1)
        assert work.claim("three").id == first.id
        clock.turn(days=1)


@pytest.mark.parametrize("seconds", [-29, 29])
def test_a_clock_that_jumps_by_less_than_a_lease_takes_no_job_away(submit, clock, work, seconds):
    submit()
    assert work.claim("one") is not None
    clock.turn(seconds=seconds)
    assert work.claim("two") is None


@pytest.fixture
def machines(tmp_path, database, write_submission):
    """Yield the queues of three machines of one board: their clocks are hours apart."""
    boards = [
        Board.open(
            tmp_path / "board",
            "quick-v1",
            url=database,
            clock=lambda hours=hours: datetime.now(UTC) + timedelta(hours=hours),
        )
        for hours in (0, 1, -1)
    ]
    Queue(boards[2]).enqueue(boards[2].keep(write_submission()), "Ada")
    yield boards
    for board in boards:
        board.close()


def test_workers_whose_clocks_are_hours_apart_take_no_job_from_each_other(machines):
    """Submission, claim, heartbeat and the wait after a fault: on each machine in turn."""
    began = datetime.now(UTC)
    works = [WorkerQueue(board) for board in machines]
    for here in works:
        others = [each for each in works if each is not here]
        job = here.claim("host/here/1/2")
        assert job is not None
        here.report(job, "public run", 1)
        assert [each.claim("host/there/1/2") for each in others] == [None, None]
        here.report(job, "audit", 2)
        here.release(job)
    job = works[1].claim("host/there/1/2")
    works[1].fault(job, "no disk")
    assert [each.claim("host/here/1/2") for each in works] == [None, None, None]
    now = Queue(machines[0]).job(job.id)
    assert began - SKEW <= now.submitted_at <= now.started_at <= now.heartbeat_at
    assert now.heartbeat_at <= datetime.now(UTC) + SKEW


def test_what_workers_with_other_clocks_publish_has_one_time(machines):
    job = WorkerQueue(machines[1]).claim("host/there/1/2")
    WorkerQueue(machines[1]).finish(job, outcome(job), make_errors(10.0))
    ended = Queue(machines[0]).job(job.id).ended_at
    assert machines[0].entry("1", job.submission).at == ended
    assert abs(ended - datetime.now(UTC)) < timedelta(minutes=5)


def test_a_lease_ends_by_the_clock_of_the_database_alone(machines):
    """A worker that is really silent for a lease loses its job, whatever it believes."""
    first = WorkerQueue(machines[1], lease=timedelta(seconds=0.3))
    job = first.claim("host/there/1/2")
    time.sleep(0.5)
    second = WorkerQueue(machines[2], lease=timedelta(seconds=0.3))
    assert second.claim("host/here/1/2").id == job.id
    with pytest.raises(LostError):
        first.report(job)
