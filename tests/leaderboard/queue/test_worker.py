"""Workers: from the queue to a row, whatever happens to them on the way.

What the database decides is in the tests of the queue, and of workers in processes.
"""

import errno
import time
from dataclasses import replace
from datetime import timedelta

import pytest
from colift.agents.sandbox.host import levels
from colift.base.errors import EvaluatorFault, InputError
from colift.leaderboard.core.decisions import Decisions
from colift.leaderboard.evaluation.progress import BudgetError, Callbacks
from colift.leaderboard.queue import NO_QUOTA, Queue, WorkerQueue
from colift.leaderboard.queue import worker as module
from colift.leaderboard.queue.worker import Worker
from colift.leaderboard.replays.chosen import made_replays
from colift.leaderboard.storage.store import Store
from colift.leaderboard.views.job import STAGES

pytestmark = pytest.mark.slow

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
def database():
    """No URL: the file in the board's folder."""


@pytest.fixture
def board(open_board, tiny_suite):
    return open_board(suite="tiny")


@pytest.fixture
def queue(board):
    return Queue(board, quota=NO_QUOTA)


def test_a_submission_becomes_a_verified_row(board, queue, write_submission):
    job = queue.enqueue(board.keep(write_submission()), "Ada")
    states, stages = set(), []
    watch = Callbacks(
        stage=lambda stage: (stages.append(stage), states.add(queue.job(job.id).state)),
    )
    done = Worker(WorkerQueue(queue.board), name="one").once(watch=watch)
    assert (done.id, done.state, done.attempt, done.worker) == (job.id, "done", 1, "one")
    assert done.done == done.total > 8
    assert stages == ["two people", *STAGES]
    assert "running" in states
    (standing,) = board.standings()
    assert (standing.row.name, standing.row.verified, standing.submitter) == ("mine", True, "Ada")
    bundle = board.bundle("1", job.submission)
    assert (bundle / "traces.npz").is_file()
    assert {each["policy"] for each in made_replays(bundle)} == {"mine"}
    assert board.human_human().rmse_mm.mean > 0
    for words in ("check", "public run", "hidden run", "0 of 2 public lifts failed", "done"):
        assert words in done.log
    assert list((board.folder / "private/work").iterdir()) == []
    assert Worker(WorkerQueue(queue.board)).once() is None


def test_a_row_is_evaluated_again_and_its_entry_stays(board, queue, write_submission):
    job = queue.enqueue(board.keep(write_submission()), "Ada")
    worker = Worker(WorkerQueue(board))
    worker.once()
    before, entry = board.standings()[0].row, board.entry("1", job.submission)
    ruined = replace(before, description="made on a busy machine")
    Decisions(board).rescore("1", ruined, (99.0, 99.0), "Grace", "to be undone")
    (board.bundle("1", job.submission) / "episodes.csv").unlink()
    new = worker.rescore("1", job.submission, "Grace", "the machine was busy")
    (standing,) = board.standings()
    assert standing.row == new
    assert (new.hidden.rmse_mm, new.description) == (before.hidden.rmse_mm, before.description)
    assert [event.why for event in standing.events] == ["to be undone", "the machine was busy"]
    assert board.entry("1", job.submission) == entry
    assert (board.bundle("1", job.submission) / "episodes.csv").is_file()
    with pytest.raises(InputError, match="season 1 has no row of submission x"):
        worker.rescore("1", "x", "Grace", "no such row")


def test_what_acts_by_chance_is_refused_with_the_reason(
    board, queue, write_submission, monkeypatch
):
    """It passes the check, as if that were on other lifts, but not the audit."""
    monkeypatch.setattr(
        "colift.leaderboard.evaluation.evaluate.presubmission_checks", lambda *_: ()
    )
    job = queue.enqueue(board.keep(write_submission(REFUSED)), "Ada")
    done = Worker(WorkerQueue(queue.board)).once()
    assert done.state == "failed"
    assert board.entry("1", job.submission).refusal == done.reason
    assert board.standings() == ()
    assert board.bundle("1", job.submission).is_dir()
    assert f"refused: {done.reason}" in done.log


def test_what_fails_the_check_has_no_row_but_the_reason(board, queue, write_submission):
    job = queue.enqueue(board.keep(write_submission(RAISES)), "Ada")
    done = Worker(WorkerQueue(queue.board)).once()
    assert (done.state, done.ended) == ("failed", True)
    assert "the check of its lifts failed" in done.reason
    assert "step 0: RuntimeError: my own mistake" in done.reason
    assert f"failed: {done.reason}" in done.log
    assert board.entry("1", job.submission) is None
    assert board.standings() == ()
    assert board.bundle("1", job.submission) is None


PRINTS = """
print("2026-11-26 08:00:00 done\\n\\x1b[2Jred")

class Policy:
    def reset(self, seed): pass
    def act(self, observation): raise RuntimeError("my own mistake")
"""


@pytest.mark.parametrize("checked", [True, False], ids=["in the check", "in the public run"])
def test_the_log_of_a_policy_that_fails_ends_with_its_output(
    board, queue, write_submission, monkeypatch, checked
):
    """Its lines are not taken for the log's own, and it controls no terminal."""
    if not checked:
        monkeypatch.setattr(
            "colift.leaderboard.evaluation.evaluate.presubmission_checks", lambda *_: ()
        )
    queue.enqueue(board.keep(write_submission(PRINTS)), "Ada")
    done = Worker(WorkerQueue(queue.board)).once()
    assert (done.state, "it printed" in done.reason) == ("failed", False)
    lines = done.log.splitlines()
    first = next(i for i, line in enumerate(lines) if line.endswith(" it printed:"))
    output = lines[first + 1 : -1]
    assert output[:2] == ["    2026-11-26 08:00:00 done", "    red"]
    assert output[-1] == "    RuntimeError: my own mistake"
    assert all(line.startswith("    ") for line in output)
    assert lines[-1].endswith(f"failed: {done.reason}")


def test_the_output_in_a_log_is_bounded(board, queue, write_submission):
    code = PRINTS.replace("raise", "print(9 * 10**5 * '-'); raise")
    queue.enqueue(board.keep(write_submission(code)), "Ada")
    done = Worker(WorkerQueue(queue.board)).once()
    assert "RuntimeError: my own mistake" in done.log.partition("it printed:")[2]
    assert len(done.log) < 12_000


class Hours:
    """Time that passes when somebody says so, or sleeps."""

    def __init__(self):
        self.now = 100.0

    def monotonic(self):
        return self.now

    def sleep(self, seconds):
        self.now += seconds


@pytest.mark.parametrize("error", [InputError("MARK"), RuntimeError("MARK")])
def test_of_the_hidden_run_nothing_is_told_before_its_end(
    board, queue, write_submission, clock, monkeypatch, error
):
    """Not how many lifts are done, nor when it ended to better than a tick, nor why it failed."""
    job = queue.enqueue(board.keep(write_submission()), "Ada")
    seen, hours = [], Hours()
    monkeypatch.setattr("colift.leaderboard.evaluation.progress.time", hours)
    monkeypatch.setattr("colift.leaderboard.evaluation.progress.TICK_S", 1.0)
    monkeypatch.setattr("colift.leaderboard.queue.heartbeat.PERIOD_S", 0.02)

    def heartbeat():
        clock.turn(seconds=1)
        deadline = time.monotonic() + 60
        while queue.job(job.id).heartbeat_at != clock.now:
            assert time.monotonic() < deadline

    def fail(*arguments, **more):
        tell = more["watch"]
        tell.stage("public run")
        tell.progress(3)
        hours.now = 200.25
        tell.stage("hidden run")
        for _ in range(2):
            tell.progress(1)
            heartbeat()
            heartbeat()  # The first may report what was read before this stage.
            seen.append(queue.job(job.id))
            hours.now += 1.2
        raise error

    monkeypatch.setattr(module, "evaluate_entrant", fail)
    ended = Worker(WorkerQueue(board)).once()
    assert seen[0].done >= 3
    assert {(each.stage, each.done) for each in seen} == {("hidden run", seen[0].done)}
    assert hours.now == pytest.approx(204.25), "two lifts: ticks of two seconds"
    assert "MARK" not in ended.reason + ended.log


def test_who_has_the_folder_is_not_kept_waiting(board, queue, write_submission, monkeypatch):
    monkeypatch.setattr("colift.leaderboard.evaluation.progress.TICK_S", 1000.0)
    queue.enqueue(board.keep(write_submission()))
    assert Worker(WorkerQueue(board)).once().state == "done"


def test_without_a_sandbox_nothing_is_evaluated_and_it_is_tried_again(
    board, queue, write_submission, clock, monkeypatch
):
    """Every level fails but limits, which is there for who names it."""
    levels.forget()

    def weak(name):
        return [] if name == "limits" else ["it can read a secret"]

    job = queue.enqueue(board.keep(write_submission()), "Ada")
    with monkeypatch.context() as patched:
        patched.setattr(levels, "holes", weak)
        patched.setattr(levels, "_PAUSE_SECONDS", 0.0)
        for _ in range(6):
            waits = Worker(WorkerQueue(board)).once()
            assert (waits.state, waits.ended) == ("evaluator fault", False)
            assert "bubblewrap does not work here: it can read a secret" in waits.reason
            assert Worker(WorkerQueue(board)).once() is None
            clock.turn(minutes=1)
        assert board.entry("1", job.submission) is None
        done = Worker(WorkerQueue(board), isolation="limits").once()
    assert done.reason is None
    assert done.state == "done"
    (standing,) = board.standings()
    assert (standing.row.isolation, standing.row.verified) == ("limits", False)
    levels.forget()


def test_the_time_of_an_evaluation_is_told_as_the_reason(
    board, queue, write_submission, monkeypatch
):
    queue.enqueue(board.keep(write_submission()), "Ada")

    def spend(*arguments, **more):
        more["watch"].stage("hidden run")
        raise BudgetError("the policy took more than 7200 s")

    monkeypatch.setattr(module, "evaluate_entrant", spend)
    assert Worker(WorkerQueue(board)).once().reason == "the policy took more than 7200 s"


def test_a_full_disk_ends_no_worker(board, queue, write_submission, monkeypatch, caplog):
    """A log cannot be written, nor the fault in detail: the job is tried again all the same."""
    job = queue.enqueue(board.keep(write_submission()), "Ada")

    def full(*arguments):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Store, "add_to_log", full)
    monkeypatch.setattr(Store, "add_to_private_log", full)
    monkeypatch.setattr(Store, "workspace", full)
    faulty = Worker(WorkerQueue(board)).once()
    assert (faulty.id, faulty.state, faulty.ended) == (job.id, "evaluator fault", False)
    assert "No space left on device" in caplog.text


def test_what_cannot_be_loaded_fails_with_the_reason(board, queue, write_submission):
    code = "raise ImportError('no scipy here')\n"
    queue.enqueue(board.keep(write_submission(code)), "Ada")
    done = Worker(WorkerQueue(queue.board)).once()
    assert (done.state, done.attempt) == ("failed", 1) or "no scipy here" in done.log


def test_a_machine_that_fails_tries_again_and_gives_the_same_row(
    board, queue, write_submission, clock, monkeypatch
):
    job = queue.enqueue(board.keep(write_submission()), "Ada")
    real = module.evaluate_entrant

    def break_down(*arguments, **more):
        more["watch"].stage("hidden run")
        raise EvaluatorFault("MARK hidden seed 123")

    monkeypatch.setattr(module, "evaluate_entrant", break_down)
    faulty = Worker(WorkerQueue(queue.board)).once()
    assert (faulty.state, faulty.ended) == ("evaluator fault", False)
    assert "MARK" not in faulty.reason + faulty.log
    private = board.folder / "private/1/logs" / f"{job.id}.txt"
    assert "MARK hidden seed 123" in private.read_text()
    assert private.stat().st_mode & 0o077 == 0
    monkeypatch.setattr(module, "evaluate_entrant", real)
    assert Worker(WorkerQueue(queue.board)).once() is None
    clock.turn(minutes=1)
    done = Worker(WorkerQueue(queue.board)).once()
    assert (done.state, done.attempt, done.reason) == ("done", 2, None)


@pytest.mark.parametrize("error", [RuntimeError("a bug of ours"), InputError("a policy's fault")])
def test_before_hidden_lifts_the_reason_is_told(board, queue, write_submission, monkeypatch, error):
    queue.enqueue(board.keep(write_submission()), "Ada")

    def fail(*arguments, **more):
        more["watch"].stage("public run")
        raise error

    monkeypatch.setattr(module, "evaluate_entrant", fail)
    done = Worker(WorkerQueue(queue.board)).once()
    assert str(error) in done.reason
    assert str(error) in done.log
    assert done.state == ("failed" if isinstance(error, InputError) else "evaluator fault")


def test_ctrl_c_gives_the_job_back(board, queue, write_submission, monkeypatch):
    job = queue.enqueue(board.keep(write_submission()), "Ada")

    def interrupt(*arguments, **more):
        raise KeyboardInterrupt

    monkeypatch.setattr(module, "evaluate_entrant", interrupt)
    with pytest.raises(KeyboardInterrupt):
        Worker(WorkerQueue(queue.board)).once()
    assert queue.job(job.id).state == "queued"


def test_who_has_lost_a_job_stops_and_changes_nothing(
    board, queue, write_submission, clock, monkeypatch
):
    quick = WorkerQueue(board, lease=timedelta(seconds=1))
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

    monkeypatch.setattr(module, "evaluate_entrant", lose)
    monkeypatch.setattr("colift.leaderboard.queue.heartbeat.PERIOD_S", 0.05)
    now = Worker(quick, name="one").once()
    assert (now.worker, now.attempt, now.state) == ("another", 2, "running")
    assert board.entry("1", job.submission) is None
