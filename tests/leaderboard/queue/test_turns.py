"""Turns: each job once, to one worker, fairly between submitters."""

import threading
from concurrent.futures import ThreadPoolExecutor

import pytest
from colift.leaderboard.queue import (
    Queue,
    Quota,
    QuotaError,
)


def test_a_submission_waits_until_somebody_takes_it(submit, queue, clock, work):
    job = submit()
    assert (job.state, job.name, job.submitter, job.season) == ("queued", "mine", "Ada", "1")
    assert (job.submitted_at, job.started_at, job.attempt, job.ended) == (clock.now, None, 0, False)
    assert len(job.id) == 32
    clock.turn(seconds=5)
    taken = work.claim("one")
    assert (taken.id, taken.state, taken.worker, taken.attempt) == (job.id, "running", "one", 1)
    assert taken.started_at == clock.now
    assert queue.job(job.id) == taken
    assert work.claim("two") is None


def test_the_same_content_is_one_job_a_season(submit, queue, board):
    first = submit()
    assert submit() == first
    assert submit(submitter="Grace") == first
    board.new_season("2")
    second = submit()
    assert (second.season, second.id == first.id) == ("2", False)
    assert {job.id for job in queue.jobs()} == {first.id, second.id}


def test_submitters_take_turns(submit, queue, clock, work):
    """Ada's five are there first; Grace and Mary do not wait for all of them."""
    for name in ("a1", "a2", "a3"):
        submit(name, "Ada")
        clock.turn(seconds=1)
    for name, who in (("g1", "Grace"), ("m1", "Mary"), ("g2", "Grace")):
        submit(name, who)
        clock.turn(seconds=1)
    order = ["a1", "g1", "m1", "a2", "g2", "a3"]
    assert [job.name for job in queue.waiting()] == order
    assert [work.claim("w").name for _ in order] == order


def test_of_those_with_nothing_at_work_the_one_served_longest_ago_is_next(submit, clock, work):
    for name, who in (("a1", "Ada"), ("g1", "Grace"), ("a2", "Ada"), ("g2", "Grace")):
        submit(name, who)
        clock.turn(seconds=1)
    served = []
    for _ in range(4):
        served.append(job := work.claim("w"))
        clock.turn(seconds=1)
        work.fail(job, "no")
    assert [job.name for job in served] == ["a1", "g1", "a2", "g2"]


def test_who_has_more_at_work_waits(submit, clock, work):
    submit("a1", "Ada")
    first = work.claim("one")
    clock.turn(seconds=1)
    submit("a2", "Ada")
    submit("g1", "Grace")
    work.report(first, "public run", 1)
    assert work.claim("two").name == "g1"
    assert work.claim("three").name == "a2"


def test_the_oldest_comes_first(submit, queue, clock, work):
    jobs = []
    for name in "cab":
        jobs.append(submit(name).id)
        clock.turn(seconds=1)
    assert [work.claim("w").id for _ in jobs] == jobs
    assert [job.id for job in queue.jobs()] == jobs[::-1]
    assert [job.id for job in queue.jobs(limit=1)] == jobs[-1:]
    assert queue.jobs("queued") == ()


@pytest.mark.slow
def test_each_of_many_is_queued_once_and_taken_once_whoever_asks(board, write_submission, work):
    """Twenty submitters, each with its ten in five threads; then eight workers."""
    limit = Quota(open=8)
    queue = Queue(board, quota=limit)
    kept = [
        board.keep(write_submission(name=f"p{i}", code=f"class Policy: ...  # {i}"))
        for i in range(40)
    ]

    def enqueue(number):
        try:
            return queue.enqueue(kept[number % 40], f"submitter {number % 4}").id
        except QuotaError:
            return None

    with ThreadPoolExecutor(10) as pool:
        ids = list(pool.map(enqueue, range(120)))
    jobs = queue.jobs(limit=1000)
    assert len(jobs) == 4 * 8
    assert set(ids) - {None} == {job.id for job in jobs}
    assert len({job.submission for job in jobs}) == len(jobs)
    start, taken = threading.Barrier(8), []

    def labour(name):
        start.wait()
        while (job := work.claim(name)) is not None:
            taken.append(job.id)
            work.report(job, "public run", 1)
            work.fail(job, "no")

    with ThreadPoolExecutor(8) as pool:
        list(pool.map(labour, [f"worker {i}" for i in range(8)]))
    assert sorted(taken) == sorted(job.id for job in jobs)
    assert {job.attempt for job in queue.jobs(limit=1000)} == {1}
