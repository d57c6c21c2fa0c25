"""Workers in processes of their own: killed, side by side, asked to end; on either database."""

import contextlib
import dataclasses
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import pytest
from colift.benchmark.verification import verify
from colift.leaderboard.core.board import Board
from colift.leaderboard.queue import NO_QUOTA, Queue
from colift.leaderboard.records.job import HELD
from colift.leaderboard.views.job import STAGES

from .. import tiny
from ..postgresql import SETTINGS, as_its_user, binaries, server

pytestmark = pytest.mark.slow

KILLS = int(os.environ.get("COLIFT_TEST_KILLS", "2"))


@pytest.fixture
def start(tmp_path, database):
    """Return what starts ``colift worker`` in a process of its own, and gives its id."""
    with (
        (tmp_path / "stderr.txt").open("w") as told,
        subprocess.Popen(
            [sys.executable, tiny.__file__, "--fork"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=told,
            env={**os.environ, "COLIFT_DATABASE_URL": database or ""},
            text=True,
        ) as server,
    ):

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
    """Return a row without its name and without what follows from the clock."""
    public = dataclasses.replace(row.public, step_ms_p50=None, step_ms_p99=None, real_time=None)
    hidden = dataclasses.replace(row.hidden, real_time=None)
    return dataclasses.replace(row, public=public, hidden=hidden, name="", submission="")


def test_workers_that_are_killed_lose_nothing(real_board, write_submission, start):
    """They are killed at work, in any stage of it."""
    board, queue = real_board, Queue(real_board)
    jobs = enqueue(board, write_submission, "ab")
    chance = random.Random(6)

    def at_work(stages):
        states = [queue.job(job.id) for job in jobs]
        return any(job.state in HELD and job.stage in stages for job in states)

    for _ in range(KILLS):
        process, stages = start(), STAGES[chance.randrange(len(STAGES)) :]
        wait_for(lambda stages=stages: at_work(stages))
        os.kill(process, signal.SIGKILL)
        wait_for(lambda process=process: not runs(process))
    start("--once")
    wait_for(lambda: all(queue.job(job.id).ended for job in jobs))
    ended = [queue.job(job.id) for job in jobs]
    assert [job.state for job in ended] == ["done"] * 2
    assert sum(job.attempt for job in ended) > 2, "none was killed at work"
    rows = {each.row.submission: each.row for each in board.standings()}
    assert set(rows) == {job.submission for job in jobs}
    assert len({repr(nameless(row)) for row in rows.values()}) == 1
    for job in jobs:
        assert verify(board.bundle("1", job.submission)).ok


def test_two_workers_share_the_queue(real_board, write_submission, start):
    jobs = enqueue(real_board, write_submission, "abc")
    both = [start("--once") for _ in range(2)]
    wait_for(lambda: not any(map(runs, both)))
    done = [Queue(real_board).job(job.id) for job in jobs]
    assert [(job.state, job.attempt) for job in done] == [("done", 1)] * 3
    assert {int(job.worker.split("/")[2]) for job in done} == set(both)
    assert len(real_board.standings()) == 3


def test_a_worker_that_is_asked_to_end_gives_its_job_back(
    real_board, write_submission, start, tmp_path
):
    """Also if it is asked twice: that is no reason for a traceback."""
    (job,) = enqueue(real_board, write_submission, "a")
    process, queue = start(), Queue(real_board)
    wait_for(lambda: queue.job(job.id).stage in STAGES)
    os.kill(process, signal.SIGTERM)
    time.sleep(0.05)
    with contextlib.suppress(ProcessLookupError):
        os.kill(process, signal.SIGTERM)
    wait_for(lambda: not runs(process))
    told = (tmp_path / "stderr.txt").read_text()
    assert "ended; an unfinished evaluation is back in the queue" in told
    assert "Traceback" not in told
    assert queue.job(job.id).state == "queued"
    assert "interrupted; queued again" in queue.job(job.id).log


@pytest.mark.usefixtures("postgresql")  # To be skipped where there is none.
def test_a_worker_waits_for_a_database_that_is_away_at_its_start(
    tmp_path, tiny_suite, write_submission
):
    with server() as url:
        place = Path(parse_qs(urlsplit(url).query)["host"][0])

        def control(*arguments):
            command = [binaries() / "pg_ctl", "-D", place / "data", *arguments]
            subprocess.run(command, check=True, **as_its_user(place))

        board = Board.open(tmp_path / "board", "tiny", url=url)
        (job,) = enqueue(board, write_submission, "a")
        board.close()
        control("stop", "-m", "fast")
        told = tmp_path / "stderr.txt"
        words = [sys.executable, tiny.__file__, "worker", "--board", tmp_path / "board"]
        environment = {**os.environ, "COLIFT_DATABASE_URL": url}
        with told.open("w") as file:
            worker = subprocess.Popen([*words, "--jobs", "1"], stderr=file, env=environment)
        try:
            wait_for(lambda: "waiting for the database: " in told.read_text())
            once = subprocess.run(
                [*words, "--once"], env=environment, capture_output=True, text=True, check=False
            )
            assert (once.returncode, "cannot be opened" in once.stderr) == (2, True)
            assert "Traceback" not in once.stderr
            assert worker.poll() is None
            control("start", "-w", "-l", place / "log.txt", "-o", f"{SETTINGS} -k {place}")
            board = Board.open(tmp_path / "board", "tiny", url=url)
            wait_for(lambda: Queue(board).job(job.id).state == "done")
            assert told.read_text().count("waiting for the database") == 1
            assert Queue(board).attendance().present
            worker.send_signal(signal.SIGTERM)
            assert worker.wait(60) == 0, told.read_text()
            assert not Queue(board).attendance().present
            board.close()
        finally:
            worker.kill()
            worker.wait()
