"""Workers: from the queue to a row, whatever happens to them on the way."""

import dataclasses
import os
import random
import signal
import subprocess
import sys
import time
from datetime import timedelta
from pathlib import Path

import pytest
from colift.agents.errors import EvaluatorFault, InputError
from colift.benchmark.verification import verify
from colift.leaderboard import worker as module
from colift.leaderboard.board import Board
from colift.leaderboard.evaluation import Watch
from colift.leaderboard.queue import NO_QUOTA, Queue, Work
from colift.leaderboard.worker import Worker

from . import tiny

KILLS = int(os.environ.get("COLIFT_TEST_KILLS", "3"))

REFUSED = """
import os

class Policy:
    def reset(self, seed): pass
    def act(self, observation): return [os.urandom(1)[0] * 1e-6]
"""

RAISES = """
class Policy:
    def reset(self, seed): pass
    def act(self, observation): raise RuntimeError("my own mistake")
"""


@pytest.fixture
def board(open_board, tiny_suite):
    return open_board(suite="tiny")


@pytest.fixture
def queue(board):
    return Queue(board, quota=NO_QUOTA)


def without_times(row):
    public = dataclasses.replace(row.public, step_ms_p50=None, step_ms_p99=None)
    return dataclasses.replace(row, public=public)


def test_a_submission_becomes_a_verified_row(board, queue, write_submission):
    job = queue.enqueue(board.keep(write_submission()), "Ada")
    states, stages = set(), []
    watch = Watch(
        stage=lambda stage: (stages.append(stage), states.add(queue.job(job.id).state)),
    )
    done = Worker(Work(queue.board), name="one").once(watch=watch)
    assert (done.id, done.state, done.attempt, done.worker) == (job.id, "done", 1, "one")
    assert done.done == done.total > 8
    assert stages[:2] == ["human-human team", "public run"]
    assert "running" in states
    (standing,) = board.standings()
    assert (standing.row.name, standing.row.verified, standing.submitter) == ("mine", True, "Ada")
    assert (board.bundle("1", job.submission) / "traces.npz").is_file()
    assert board.team().rmse_mm.mean > 0
    for words in ("public run", "hidden run", "0 of 2 public episodes failed", "done"):
        assert words in done.log
    assert list((board.folder / "private/work").iterdir()) == []
    assert Worker(Work(queue.board)).once() is None


def test_what_acts_by_chance_is_refused_with_the_reason(board, queue, write_submission):
    job = queue.enqueue(board.keep(write_submission(REFUSED)), "Ada")
    done = Worker(Work(queue.board)).once()
    assert done.state == "failed"
    assert board.entry("1", job.submission).refusal == done.reason
    assert board.standings() == ()
    assert board.bundle("1", job.submission).is_dir()
    assert f"refused: {done.reason}" in done.log


def test_failures_of_public_lifts_are_in_the_log(board, queue, write_submission):
    queue.enqueue(board.keep(write_submission(RAISES)), "Ada")
    done = Worker(Work(queue.board)).once()
    assert done.state == "done"
    assert "2 of 2 public episodes failed" in done.log
    assert "seed 0: step 0: RuntimeError: my own mistake" in done.log


def test_what_cannot_be_loaded_fails_with_the_reason(board, queue, write_submission):
    code = "raise ImportError('no scipy here')\n"
    manifest = ("preload = false", "preload = true")
    queue.enqueue(board.keep(write_submission(code, manifest=manifest)), "Ada")
    done = Worker(Work(queue.board)).once()
    assert (done.state, done.attempt) == ("failed", 1) or "no scipy here" in done.log


def test_a_machine_that_fails_tries_again_and_gives_the_same_row(
    board, queue, write_submission, clock, monkeypatch
):
    job = queue.enqueue(board.keep(write_submission()), "Ada")
    real = module.evaluate

    def break_down(*arguments, **more):
        more["watch"].stage("hidden run")
        raise EvaluatorFault("MARK hidden seed 123")

    monkeypatch.setattr(module, "evaluate", break_down)
    faulty = Worker(Work(queue.board)).once()
    assert (faulty.state, faulty.ended) == ("evaluator fault", False)
    assert "MARK" not in faulty.reason + faulty.log
    private = board.folder / "private/1/logs" / f"{job.id}.txt"
    assert "MARK hidden seed 123" in private.read_text()
    assert private.stat().st_mode & 0o077 == 0
    monkeypatch.setattr(module, "evaluate", real)
    assert Worker(Work(queue.board)).once() is None
    clock.turn(minutes=1)
    done = Worker(Work(queue.board)).once()
    assert (done.state, done.attempt, done.reason) == ("done", 2, None)


@pytest.mark.parametrize("error", [RuntimeError("a bug of ours"), InputError("a policy's fault")])
def test_before_hidden_lifts_the_reason_is_told(board, queue, write_submission, monkeypatch, error):
    queue.enqueue(board.keep(write_submission()), "Ada")

    def fail(*arguments, **more):
        more["watch"].stage("public run")
        raise error

    monkeypatch.setattr(module, "evaluate", fail)
    done = Worker(Work(queue.board)).once()
    assert str(error) in done.reason
    assert str(error) in done.log
    assert done.state == ("failed" if isinstance(error, InputError) else "evaluator fault")


def test_ctrl_c_gives_the_job_back(board, queue, write_submission, monkeypatch):
    job = queue.enqueue(board.keep(write_submission()), "Ada")

    def interrupt(*arguments, **more):
        raise KeyboardInterrupt

    monkeypatch.setattr(module, "evaluate", interrupt)
    with pytest.raises(KeyboardInterrupt):
        Worker(Work(queue.board)).once()
    assert queue.job(job.id).state == "queued"


def test_who_has_lost_a_job_stops_and_changes_nothing(
    board, queue, write_submission, clock, monkeypatch
):
    quick = Work(board, lease=timedelta(seconds=1))
    job = queue.enqueue(board.keep(write_submission()), "Ada")

    def lose(*arguments, **more):
        clock.turn(minutes=1)  # It was stopped for so long, and so were its signs of life.
        while quick.claim("another") is None:
            clock.turn(minutes=1)  # One came in between.
        deadline = time.monotonic() + 20
        while time.monotonic() < deadline:
            more["watch"].progress(0)
            time.sleep(0.05)
        raise AssertionError("it was not told")

    monkeypatch.setattr(module, "evaluate", lose)
    monkeypatch.setattr("colift.leaderboard.pulse.PERIOD_S", 0.05)
    now = Worker(quick, name="one").once()
    assert (now.worker, now.attempt, now.state) == ("another", 2, "running")
    assert board.entry("1", job.submission) is None


@pytest.fixture
def start(tmp_path, database):
    """Return what starts ``colift worker`` in a process of its own, and gives its id."""
    with subprocess.Popen(
        [sys.executable, tiny.__file__, "--fork"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env={**os.environ, "COLIFT_DATABASE_URL": database or ""},
        text=True,
    ) as server:

        def command(*arguments):
            words = ("worker", "--board", str(tmp_path / "board"), "--jobs", "1", *arguments)
            print(*words, file=server.stdin, flush=True)
            return int(server.stdout.readline())

        yield command


def wait_for(condition):
    """Wait until it holds; every other step of a test has a time of its own."""
    deadline = time.monotonic() + 200
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def runs(process):
    return Path(f"/proc/{process}").exists()


@pytest.fixture
def real_board(tmp_path, database, tiny_suite):
    """Yield a board whose clock is that of the processes that work for it."""
    board = Board.open(tmp_path / "board", "tiny", url=database)
    yield board
    board.close()


def enqueue(board, write_submission, names):
    """Put the same policy into the queue under several names; return the jobs."""
    queue = Queue(board, quota=NO_QUOTA)
    return [queue.enqueue(board.keep(write_submission(name=name)), "Ada") for name in names]


def nameless(row):
    return dataclasses.replace(without_times(row), name="", submission="")


def test_workers_that_are_killed_lose_nothing(real_board, write_submission, start):
    """Some are killed: 0 to 1.5 s after they took a job, which takes them about as long."""
    board, queue = real_board, Queue(real_board)
    jobs = enqueue(board, write_submission, "abc")
    chance, killed = random.Random(6), 0
    while killed < KILLS and not all(queue.job(job.id).ended for job in jobs):
        begun = [queue.job(job.id).attempt for job in jobs]
        process = start()
        wait_for(lambda begun=begun: begun != [queue.job(job.id).attempt for job in jobs])
        time.sleep(chance.uniform(0.0, 1.5))
        os.kill(process, signal.SIGKILL)
        wait_for(lambda process=process: not runs(process))
        killed += 1
    start("--once")
    wait_for(lambda: all(queue.job(job.id).ended for job in jobs))
    ended = [queue.job(job.id) for job in jobs]
    assert [job.state for job in ended] == ["done"] * 3
    assert sum(job.attempt for job in ended) > 3, "none was killed at work"
    rows = {each.row.submission: each.row for each in board.standings()}
    assert set(rows) == {job.submission for job in jobs}
    assert len({repr(nameless(row)) for row in rows.values()}) == 1
    for job in jobs:
        assert verify(board.bundle("1", job.submission)).ok


def test_two_workers_share_the_queue(real_board, write_submission, start):
    jobs = enqueue(real_board, write_submission, "abcd")
    both = [start("--once") for _ in range(2)]
    wait_for(lambda: not any(map(runs, both)))
    done = [Queue(real_board).job(job.id) for job in jobs]
    assert [(job.state, job.attempt) for job in done] == [("done", 1)] * 4
    assert {int(job.worker.split("/")[2]) for job in done} == set(both)
    assert len(real_board.standings()) == 4


def test_a_worker_that_is_asked_to_end_gives_its_job_back(real_board, write_submission, start):
    (job,) = enqueue(real_board, write_submission, "a")
    process, queue = start(), Queue(real_board)
    wait_for(lambda: queue.job(job.id).stage == "public run")
    os.kill(process, signal.SIGTERM)
    wait_for(lambda: not runs(process))
    assert queue.job(job.id).state == "queued"
    assert "interrupted; queued again" in queue.job(job.id).log
