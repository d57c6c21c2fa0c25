"""Worker processes that a service starts, starts again when they end, and takes with it."""

import contextlib
import logging
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Final

log: Final = logging.getLogger("colift.service")

LOOK_S: Final = 0.5
"""How often the workers are looked at [s]."""

PAUSE_S: Final = 1.0
"""Before a worker is started again [s]; twice as long every time, if it ends again soon."""

LONGEST_PAUSE_S: Final = 60.0

GRACE_S: Final = 10.0
"""What a worker has to end by itself [s]."""

# Also when this process is killed, so that those of the next one are not too many.
_TETHER: Final = """
import ctypes, os, signal, sys
ctypes.CDLL(None, use_errno=True).prctl(1, signal.SIGTERM)  # PR_SET_PDEATHSIG
if os.getppid() == int(sys.argv[1]):
    os.execv(sys.argv[2], sys.argv[2:])
"""


@contextmanager
def running(command: Sequence[str], count: int) -> Iterator[None]:
    """Keep so many processes running while the body runs.

    Parameters
    ----------
    command
        What each runs: a program's path, and its arguments.
    count
        How many.
    """
    stop = threading.Event()
    keepers = [
        threading.Thread(target=_keep, args=(command, stop), name=f"worker {number + 1}")
        for number in range(count)
    ]
    for keeper in keepers:
        keeper.start()
    try:
        yield
    finally:
        stop.set()
        for keeper in keepers:
            keeper.join()


def _keep(command: Sequence[str], stop: threading.Event) -> None:
    """Run the command again and again, until it shall stop."""
    pause = PAUSE_S
    while not stop.is_set():
        began = time.monotonic()
        process = start(command)
        while process.poll() is None and not stop.wait(LOOK_S):
            pass
        if stop.is_set():
            _end(process)
            return
        pause = PAUSE_S if time.monotonic() - began > LONGEST_PAUSE_S else pause
        log.error("a worker ended with code %s; next in %.0f s", process.returncode, pause)
        stop.wait(pause)
        pause = min(2 * pause, LONGEST_PAUSE_S)


def start(command: Sequence[str]) -> "subprocess.Popen[bytes]":
    """Start a process that is terminated when the calling thread ends, however that ends."""
    tether = [sys.executable, "-c", _TETHER, str(os.getpid()), *command]
    # Ctrl-C in a terminal is for the service, which then ends its workers.
    return subprocess.Popen(tether, stdin=subprocess.DEVNULL, start_new_session=True)


def _end(process: "subprocess.Popen[bytes]") -> None:
    process.send_signal(signal.SIGTERM)
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(GRACE_S)
    process.kill()
    process.wait()
