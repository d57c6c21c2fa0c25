"""Ends of a job: entry, refusal, failure, fault of the machine, cancellation."""

import dataclasses

import pytest
from colift.base.errors import InputError
from colift.leaderboard.queue import (
    FAULTS,
    LEASE,
    LOST,
    LostError,
)
from colift.leaderboard.queue.work import POSTPONED

from ..rows import make_errors, outcome


def test_entry_bundle_and_state_come_together(submit, queue, board, tmp_path, clock, work):
    submit()
    job = work.claim("one")
    bundle = tmp_path / "work" / "bundle"
    bundle.mkdir(parents=True)
    (bundle / "results.json").write_text("mine")
    clock.turn(minutes=1)
    entry = outcome(job)
    work.finish(job, entry, make_errors(10.0), bundle)
    now = queue.job(job.id)
    assert (now.state, now.done, now.total, now.ended_at) == (
        "done",
        now.total,
        now.total,
        clock.now,
    )
    assert board.entry("1", job.submission) == dataclasses.replace(entry, at=clock.now)
    assert (board.bundle("1", job.submission) / "results.json").read_text() == "mine"
    assert work.claim("two") is None


def test_who_dies_between_bundle_and_entry_leaves_a_job_for_the_next(
    submit, queue, board, tmp_path, clock, monkeypatch, work
):
    submit()
    first = work.claim("one")

    def bundle(text):
        folder = tmp_path / text
        folder.mkdir()
        (folder / "results.json").write_text(text)
        return folder

    def die(*arguments):
        raise SystemExit

    monkeypatch.setattr("colift.leaderboard.queue.work.record_entry", die)
    with pytest.raises(SystemExit):
        work.finish(first, outcome(first), make_errors(10.0), bundle("first"))
    monkeypatch.undo()
    assert (board.bundle("1", first.submission) / "results.json").read_text() == "first"
    assert (queue.job(first.id).state, board.standings()) == ("running", ())
    clock.now += 2 * LEASE
    second = work.claim("two")
    work.finish(second, outcome(second), make_errors(10.0), bundle("second"))
    assert (board.bundle("1", first.submission) / "results.json").read_text() == "second"
    assert len(board.standings()) == 1


def test_a_refusal_is_an_entry_and_a_failed_job(submit, queue, board, work):
    submit()
    job = work.claim("one")
    work.finish(job, outcome(job, refusal="played again, it differs"))
    now = queue.job(job.id)
    assert (now.state, now.reason, now.ended) == ("failed", "played again, it differs", True)
    assert board.entry("1", job.submission).refusal == "played again, it differs"
    assert submit() == now


def test_a_failure_has_a_reason_and_a_log(submit, queue, work):
    submit()
    job = work.claim("one")
    work.fail(job, "it has no act\0\udcff", "line 1\nline 2")
    now = queue.job(job.id)
    assert (now.state, now.reason) == ("failed", "it has no act?")
    assert now.log == "line 1\nline 2\n"
    assert queue.jobs("failed") == (now,)


def test_a_fault_of_the_machine_is_tried_again_and_not_for_ever(submit, queue, clock, work):
    submit()
    for number in range(FAULTS + 1):
        job = work.claim("one")
        assert job.attempt == number + 1
        work.fault(job, "the disk is full")
        now = queue.job(job.id)
        assert (now.state, now.reason) == ("evaluator fault", "the disk is full")
        assert now.ended == (number == FAULTS)
        assert work.claim("one") is None
        clock.turn(minutes=5)
    assert work.claim("one") is None
    again = submit()
    assert (again.id, again.state, again.ended) == (job.id, "queued", False)
    assert work.claim("one").attempt == FAULTS + 2


def test_a_job_that_takes_its_workers_with_it_ends(submit, queue, clock, work):
    submit()
    for _ in range(LOST + 1):
        assert work.claim("one") is not None
        clock.now += 2 * LEASE
    assert work.claim("one") is None
    (job,) = queue.jobs("evaluator fault")
    assert job.ended
    assert "sent no more heartbeats" in job.reason


def test_the_keeper_may_try_a_failed_job_again(submit, queue, board, work):
    submit()
    job = work.claim("one")
    with pytest.raises(InputError, match="has ended without an entry"):
        queue.retry(job.id, "Grace", "numpy was missing")
    work.fail(job, "numpy is missing")
    queue.retry(job.id, "Grace", "numpy was missing")
    assert queue.job(job.id).state == "queued"
    assert board.events(submission=job.submission)[0].why == "numpy was missing"
    work.finish(now := work.claim("one"), outcome(now, refusal="no"))
    with pytest.raises(InputError, match="has ended without an entry"):
        queue.retry(job.id, "Grace", "once more")
    with pytest.raises(InputError, match="no job 'x'"):
        queue.retry("x", "Grace", "once more")


def test_what_a_machine_cannot_do_waits_and_is_never_given_up(submit, queue, clock, work):
    submit()
    for number in range(3 * FAULTS):
        job = work.claim("one")
        assert job.attempt == number + 1
        work.postpone(job, "no sandbox works here")
        now = queue.job(job.id)
        assert (now.state, now.reason) == ("evaluator fault", "no sandbox works here")
        assert not now.ended
        assert work.claim("one") is None
        clock.now += POSTPONED


def test_the_maintainer_cancels_a_job_that_waits(submit, queue, board, work):
    job = submit()
    now = queue.cancel(job.id, "Grace", "too long")
    assert (now.state, now.reason, now.ended) == ("cancelled", "Grace: too long", True)
    assert queue.job(job.id) == now
    (event,) = board.events(submission=job.submission)
    assert (event.kind, event.who, event.why) == ("cancellation", "Grace", "too long")
    assert work.claim("one") is None
    assert submit() == now
    with pytest.raises(InputError, match="is in the queue"):
        queue.cancel(job.id, "Grace", "once more")
    queue.retry(job.id, "Grace", "a mistake")
    assert work.claim("one").id == job.id


def test_a_job_that_is_cancelled_is_lost_to_its_worker(submit, queue, work):
    submit()
    job = work.claim("one")
    queue.cancel(job.id, "Ada", "it hangs", submitter="Ada")
    for late in (
        lambda: work.report(job, "audit", 2),
        lambda: work.finish(job, outcome(job), make_errors(10.0)),
        lambda: work.fail(job, "no"),
        lambda: work.fault(job, "no"),
    ):
        with pytest.raises(LostError):
            late()
    assert queue.job(job.id).state == "cancelled"


def test_a_submitter_cancels_nobody_elses_job(submit, queue):
    job = submit()
    with pytest.raises(InputError, match=f"no job '{job.id}' is in the queue"):
        queue.cancel(job.id, "Grace", "envy", submitter="Grace")
    assert queue.job(job.id).state == "queued"
