"""The queue: each job once, whoever fails; quotas; and what its transactions promise."""

import os
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest
from colift.agents.errors import InputError
from colift.leaderboard.entry import Entry
from colift.leaderboard.queue import FAULTS, LEASE, LOST, LostError, Queue, Quota, QuotaError, Work
from colift.leaderboard.worker_name import is_gone, this_worker

from .rows import make_errors, make_row


@pytest.fixture
def queue(board):
    return Queue(board)


@pytest.fixture
def work(board):
    return Work(board)


@pytest.fixture
def submit(board, queue, write_submission, tmp_path):
    """Return what puts a submission of its own into the queue."""

    def put(name="mine", submitter="Ada", into=None):
        folder = tmp_path / name
        if not folder.exists():
            write_submission(name=name, code=f"class Policy: ...  # {name}")
        return (into or queue).enqueue(board.keep(folder), submitter)

    return put


def outcome(job, refusal=None):
    return Entry(
        season=job.season,
        submission=job.submission,
        name=job.name,
        submitter=job.submitter,
        at=job.started_at,
        row=None if refusal else make_row(job.name, 10.0, job.season),
        refusal=refusal,
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


def test_the_oldest_comes_first(submit, queue, clock, work):
    jobs = []
    for name in "cab":
        jobs.append(submit(name).id)
        clock.turn(seconds=1)
    assert [work.claim("w").id for _ in jobs] == jobs
    assert [job.id for job in queue.jobs()] == jobs[::-1]
    assert [job.id for job in queue.jobs(limit=1)] == jobs[-1:]
    assert queue.jobs("queued") == ()


def test_a_worker_says_how_far_it_is(submit, queue, clock, work):
    submit()
    job = work.claim("one")
    clock.turn(seconds=3)
    work.told(job, "hidden run", 30, 70)
    now = queue.job(job.id)
    assert (now.state, now.stage, now.done, now.total) == ("running", "hidden run", 30, 70)
    assert now.heartbeat_at == clock.now
    work.told(job, "verification", 60)
    assert (queue.job(job.id).state, queue.job(job.id).total) == ("verifying", 70)


def test_a_job_whose_worker_is_silent_for_a_lease_is_anothers(submit, queue, clock, work):
    submit()
    first = work.claim("one")
    clock.turn(seconds=LEASE.total_seconds() - 1)
    work.told(first, "public run", 1)
    clock.now += LEASE
    assert work.claim("two") is None
    clock.turn(seconds=1)
    second = work.claim("two")
    assert (second.id, second.worker, second.attempt, second.done) == (first.id, "two", 2, 0)
    row = outcome(first)
    for late in (
        lambda: work.told(first, "audit", 2),
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


def test_a_worker_of_this_machine_that_is_gone_is_not_waited_for(submit, queue, work):
    submit()
    ask = "from colift.leaderboard.worker_name import this_worker; print(this_worker())"
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
    assert board.entry("1", job.submission) == entry
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
    assert "gave no sign of life" in job.reason


def test_a_job_that_was_given_back_waits_again(submit, queue, work):
    submit()
    job = work.claim("one")
    work.release(job)
    assert queue.job(job.id).state == "queued"
    assert work.claim("two").attempt == 2


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


def test_what_has_an_entry_from_elsewhere_is_not_evaluated(submit, queue, board):
    from colift.leaderboard.database.recording import record_entry

    from .conftest import Clock

    job = submit()
    entry = Entry(
        season="1", submission=job.submission, name="mine", submitter="x", at=Clock()(),
        row=make_row(), refusal=None,
    )  # fmt: skip
    board.new_season("2")
    with board.database.writing() as connection:
        record_entry(connection, Entry(**{**vars(entry), "season": "2"}), make_errors(10.0))
    assert submit().state == "done"


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
            work.told(job, "public run", 1)
            work.fail(job, "no")

    with ThreadPoolExecutor(8) as pool:
        list(pool.map(labour, [f"worker {i}" for i in range(8)]))
    assert sorted(taken) == sorted(job.id for job in jobs)
    assert {job.attempt for job in queue.jobs(limit=1000)} == {1}
