"""A Dask cluster on this machine, for measurements and tests."""

import contextlib
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

from colift.base.errors import EvaluatorFault

START_SECONDS: Final = 180.0
"""Longest time for the processes to start [s]."""

IDLE_SECONDS: Final = 1800
ORPHANED_SECONDS: Final = 60
"""Time after which an unused scheduler, and a worker without a scheduler, end by themselves [s]:
the process that started them may have been killed."""

LEAN: Final = {
    "DASK_DISTRIBUTED__ADMIN__TICK__INTERVAL": "1s",
    "DASK_DISTRIBUTED__WORKER__PROFILE__ENABLED": "False",
}
"""Environment variables by which Dask's processes monitor themselves less: by default that takes a
few percent of the processors."""

END_SECONDS: Final = 10.0
"""Longest time for the processes to end before they are killed [s]."""


@contextmanager
def loopback_cluster(workers: int) -> Iterator[str]:
    """Yield the address of a Dask scheduler on this machine with some worker processes.

    They are started by the same commands that a user would type.

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
        own = ("--port", "0", "--scheduler-file", str(file), "--idle-timeout", str(IDLE_SECONDS))
        scheduler = stack.enter_context(_dask(folder, "scheduler", *own, *common))
        address = _address(file, scheduler, folder)
        if workers:
            own = ("--nworkers", str(workers), "--nthreads", "1", "--local-directory", str(folder))
            end = ("--death-timeout", str(ORPHANED_SECONDS))
            stack.enter_context(_dask(folder, "worker", address, *own, *end, *common))
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
            env={**LEAN, **os.environ},
            # Ctrl-C must reach only the measuring process.
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
            reason = _last(folder / "worker.log")
            raise EvaluatorFault(f"the Dask workers do not start: {reason}") from None


def _last(log: Path) -> str:
    """Return the last line of a log."""
    return (log.read_text(errors="replace").strip().splitlines() or ["no word"])[-1]
