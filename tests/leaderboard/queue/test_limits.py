"""Quotas of a submitter."""

import pytest
from colift.leaderboard.database.queries import record_entry
from colift.leaderboard.queue import (
    Queue,
    Quota,
    QuotaError,
)
from colift.leaderboard.records.season import BoardEntry

from ..rows import make_errors, make_row, outcome


def test_a_submitter_has_so_many_open_jobs(submit, queue, clock, work):
    for number in range(5):
        submit(f"p{number}")
    clock.turn(seconds=1)
    with pytest.raises(QuotaError, match="Ada has 5 submissions in the queue, at most 5"):
        submit("p5")
    assert submit("p0").state == "queued"
    assert submit("p5", submitter="Grace").submitter == "Grace"
    work.finish(job := work.claim("one"), outcome(job), make_errors(10.0))
    assert submit("p6").state == "queued"


def test_only_own_failures_count_and_only_for_a_day(submit, board, clock, work):
    strict = Queue(board, quota=Quota(open=9, failures=2))
    for number, end in enumerate((work.fail, work.fault, work.fault, work.fail)):
        submit(f"p{number}", into=strict)
        end(work.claim("one", job=strict.jobs("queued")[0].id), "no")
        clock.turn(seconds=1)
    with pytest.raises(QuotaError, match="2 submissions of Ada have failed in the last 24 hours"):
        submit("p8", into=strict)
    submit("p8", submitter="Grace", into=strict)
    clock.turn(days=1)
    assert submit("p9", into=strict).state == "queued"


def test_what_has_an_entry_from_elsewhere_is_not_evaluated(submit, queue, board, clock):
    job = submit()
    entry = BoardEntry(
        season="1", submission=job.submission, name="mine", submitter="x", at=clock(),
        row=make_row(), refusal=None,
    )  # fmt: skip
    board.new_season("2")
    with board.database.writing() as connection:
        record_entry(connection, BoardEntry(**{**vars(entry), "season": "2"}), make_errors(10.0))
    assert submit().state == "done"


def test_a_submitter_gets_so_many_rows_a_day(submit, board, clock, work):
    strict = Queue(board, quota=Quota(rows=3))
    for number in range(2):
        submit(f"p{number}", into=strict)
        work.finish(job := work.claim("one"), outcome(job), make_errors(10.0))
        clock.turn(seconds=1)
    submit("p2", into=strict)
    with pytest.raises(QuotaError, match="Ada has 3 rows of the last 24 hours or on the way"):
        submit("p3", into=strict)
    submit("p4", submitter="Grace", into=strict)
    work.fail(work.claim("one", job=strict.jobs("queued")[-1].id), "no")
    clock.turn(days=1)
    assert submit("p5", into=strict).state == "queued"
