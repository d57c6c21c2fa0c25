"""What a Dask cluster costs, against the local pool of processes."""

import contextlib
import json
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from pathlib import Path
from typing import Final

from ..agents.errors import EvaluatorFault
from ..agents.policies.loading import PolicySpec
from .agent_spec import AgentSpec
from .connecting import dask_pool
from .executors import process_pool
from .runner import run_suite
from .shipping import shipped
from .suite import Suite, make_suite

WORKERS: Final = 2
START_SECONDS: Final = 180.0
END_SECONDS: Final = 10.0


def dask_over_local(rounds: int = 3, suite: str = "standard-v1") -> dict[str, float]:
    """Measure the throughput of Dask on this machine over that of the local pool.

    Both have two worker processes; Dask's are behind a scheduler, also a process. They take turns,
    and the median ratio of the rounds counts.

    Parameters
    ----------
    rounds
        Pairs of runs.
    suite
        What is run.
    """
    policy, episodes = PolicySpec(text="copy"), make_suite(suite)
    ratios = []
    with (
        process_pool(WORKERS) as local,
        loopback_cluster(WORKERS) as address,
        dask_pool(address) as cluster,
    ):
        for executor in (local, cluster):
            _seconds(policy, make_suite("quick-v1"), executor)
        for _ in range(rounds):
            alone = _seconds(policy, episodes, local)
            ratios.append(alone / _seconds(shipped(policy), episodes, cluster))
    return {"dask_ratio": statistics.median(ratios)}


def _seconds(policy: AgentSpec, suite: Suite, executor: Executor) -> float:
    """Return the wall time of a run [s]."""
    begin = time.perf_counter()
    run_suite(policy, suite, executor=executor)
    return time.perf_counter() - begin


@contextmanager
def loopback_cluster(workers: int) -> Iterator[str]:
    """Yield the address of a Dask scheduler on this machine that has so many worker processes.

    They are started by the commands that a user starts them by.

    Parameters
    ----------
    workers
        Number of worker processes; 0 for the scheduler alone.

    Raises
    ------
    EvaluatorFault
        If they do not start.
    """
    with contextlib.ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="colift-")))
        file, common = folder / "scheduler.json", ("--host", "127.0.0.1", "--no-dashboard")
        own = ("--port", "0", "--scheduler-file", str(file))
        scheduler = stack.enter_context(_dask(folder, "scheduler", *own, *common))
        address = _address(file, scheduler, folder)
        if workers:
            own = ("--nworkers", str(workers), "--nthreads", "1")
            place = ("--local-directory", str(folder))
            stack.enter_context(_dask(folder, "worker", address, *own, *place, *common))
            _wait(address, workers, folder)
        yield address


@contextmanager
def _dask(folder: Path, command: str, *options: str) -> Iterator["subprocess.Popen[bytes]"]:
    """Run a command of Dask's; it ends with the context."""
    with (folder / f"{command}.log").open("wb") as log:
        process = subprocess.Popen(
            [sys.executable, "-m", "dask", command, *options],
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=log,
            # Ctrl-C is for the one who measures.
            start_new_session=True,
        )
    try:
        yield process
    finally:
        process.terminate()
        try:
            process.wait(END_SECONDS)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def _address(file: Path, scheduler: "subprocess.Popen[bytes]", folder: Path) -> str:
    """Return the address that a scheduler writes to a file once it listens."""
    end = time.monotonic() + START_SECONDS
    while time.monotonic() < end and scheduler.poll() is None:
        with contextlib.suppress(OSError, json.JSONDecodeError):
            return str(json.loads(file.read_text())["address"])
        time.sleep(0.05)
    raise EvaluatorFault(f"the Dask scheduler does not start: {_last(folder / 'scheduler.log')}")


def _wait(address: str, workers: int, folder: Path) -> None:
    from distributed import Client

    with Client(address, set_as_default=False) as client:  # type: ignore[no-untyped-call]
        try:
            client.wait_for_workers(workers, timeout=START_SECONDS)
        except TimeoutError:
            told = _last(folder / "worker.log")
            raise EvaluatorFault(f"the Dask workers do not start: {told}") from None


def _last(log: Path) -> str:
    """Return the last line of a log."""
    return (log.read_text(errors="replace").strip().splitlines() or ["no word"])[-1]
