"""The pool of local processes: what a call gives, and what the death of a worker does not take."""

import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import CancelledError
from pathlib import Path

import pytest
from colift.base.errors import EvaluatorFault, InputError, PolicyError
from colift.benchmark.execution.pool import JOBS, default_jobs, local_pool, process_pool
from colift.benchmark.execution.processors import usable_processors

ORPHANS = """
import os, signal, time
from colift.benchmark.execution.pool import LocalPool

pool = LocalPool(2)
pids = [each.result() for each in [pool.submit(os.getpid), pool.submit(os.getpid)]]
print(*pool.processes(), flush=True)
os.kill(os.getpid(), signal.SIGKILL)
"""

UNGUARDED = """
from colift.benchmark.execution.pool import process_pool

with process_pool(1) as pool:
    pool.submit(abs, -1).result()
"""


@pytest.fixture(scope="module")
def pool():
    with process_pool(2) as made:
        yield made


def test_by_default_there_is_a_worker_for_each_processor_or_what_the_environment_says(monkeypatch):
    monkeypatch.delenv(JOBS)
    assert default_jobs() == usable_processors() <= len(os.sched_getaffinity(0))
    monkeypatch.setenv(JOBS, "3")
    assert default_jobs() == 3


@pytest.mark.parametrize("asked", ["0", "-1", "two", "1.5", "²"])
def test_what_is_no_number_of_workers_is_refused(monkeypatch, asked):
    monkeypatch.setenv(JOBS, asked)
    with (
        pytest.raises(InputError, match=f"COLIFT_JOBS must be .* above 0, got '{asked}'"),
        local_pool(None),
    ):
        pass


def raise_(error):
    raise error


def unpicklable():
    return threading.Lock()


def raise_unpicklable():
    error = PolicyError("too much")
    error.held = threading.Lock()
    raise error


def wait_for(condition, seconds=60.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


def gone(pid):
    """Whether a process has ended; one that nobody has waited for counts."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


def test_calls_give_what_they_return_in_other_processes(pool):
    futures = [pool.submit(pow, 2, exponent) for exponent in range(20)]
    assert [future.result() for future in futures] == [2**exponent for exponent in range(20)]
    assert pool.submit(int, "11", base=2).result() == 3
    assert os.getpid() not in pool.processes()
    assert pool.submit(os.getpid).result() in pool.processes()


@pytest.mark.parametrize("error", [InputError("bad"), EvaluatorFault("mine"), KeyError("k")])
def test_a_call_raises_what_it_raises_there(pool, error):
    with pytest.raises(type(error), match=str(error)):
        pool.submit(raise_, error).result()


@pytest.mark.parametrize("call", [unpicklable, raise_unpicklable])
def test_what_cannot_come_back_is_said(pool, call):
    with pytest.raises((EvaluatorFault, TypeError), match=r"pickle|too much"):
        pool.submit(call).result()


@pytest.mark.parametrize("error", [SystemExit(3), KeyboardInterrupt()])
def test_what_would_end_a_worker_ends_the_call_alone(pool, error):
    before = set(pool.processes())
    with pytest.raises(EvaluatorFault, match=type(error).__name__):
        pool.submit(raise_, error).result()
    assert {pool.submit(os.getpid).result() for _ in range(4)} <= before | set(pool.processes())
    assert before == set(pool.processes())


def test_a_worker_that_dies_takes_its_own_call_only(pool):
    futures = [pool.submit(time.sleep, 0.05) for _ in range(4)]
    dying = pool.submit(os._exit, 7)
    futures += [pool.submit(abs, -5) for _ in range(8)]
    with pytest.raises(EvaluatorFault, match="a worker died: exit code 7"):
        dying.result()
    assert [future.result() for future in futures] == [None] * 4 + [5] * 8


def test_a_worker_that_is_killed_is_replaced(pool):
    killed = pool.submit(os.getpid).result()
    os.kill(killed, signal.SIGKILL)
    futures = [pool.submit(time.sleep, 0.2) for _ in range(2)]
    errors = [str(future.exception()) for future in futures if future.exception()]
    assert errors == ["a worker died: killed by SIGKILL"]
    assert [pool.submit(abs, k).result() for k in range(4)] == [0, 1, 2, 3]
    assert killed not in pool.processes()


def test_the_end_of_a_pool_is_the_end_of_its_processes_and_calls():
    with process_pool(1) as pool:
        first, second = pool.submit(time.sleep, 600), pool.submit(abs, 1)
        wait_for(pool.processes)
        pids = pool.processes()
    assert pids
    assert all(gone(pid) for pid in pids)
    assert isinstance(first.exception(), EvaluatorFault)
    with pytest.raises(CancelledError):
        second.result()
    with pytest.raises(RuntimeError):
        pool.submit(abs, 1)


def test_a_pool_that_is_waited_for_finishes_its_calls():
    with process_pool(1) as pool:
        futures = [pool.submit(abs, -k) for k in range(3)]
        pool.shutdown(wait=True)
        assert [future.result() for future in futures] == [0, 1, 2]
        assert pool.processes() == []


def test_workers_end_when_their_parent_is_killed():
    done = subprocess.run([sys.executable, "-c", ORPHANS], capture_output=True, text=True)
    pids = [int(pid) for pid in done.stdout.split()]
    assert done.returncode == -signal.SIGKILL
    assert pids
    wait_for(lambda: all(gone(pid) for pid in pids))


def test_a_script_without_the_guard_of_its_main_module_is_told_so(tmp_path):
    path = tmp_path / "unguarded.py"
    path.write_text(UNGUARDED)
    done = subprocess.run([sys.executable, path], capture_output=True, text=True)
    assert done.returncode == 1
    assert "if __name__ == '__main__':" in done.stderr
    assert "AttributeError" not in done.stderr


def test_one_job_needs_no_pool_and_none_is_refused():
    with local_pool(1) as none:
        assert none is None
    for jobs in (0, -3):
        with pytest.raises(InputError, match=f"jobs must be at least 1, got {jobs}"):
            local_pool(jobs).__enter__()
