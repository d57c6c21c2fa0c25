"""The parent of the web process: it keeps the address, and starts another if one is killed."""

import logging
import multiprocessing
import socket
import time
from multiprocessing.context import SpawnProcess
from typing import Final

from ...agents.errors import EvaluatorFault
from .keeper import PlayConfig
from .web import run_web

log: Final = logging.getLogger("colift.live")

SOON_S: Final = 10.0
"""A process that ends sooner than this has not worked [s]."""

TRIES: Final = 3
"""How many may end so soon, one after the other."""

END_S: Final = 8.0
"""What the web process has to end with its rooms [s]."""


def keep_serving(config: PlayConfig, listener: socket.socket, root: str = "") -> None:
    """Keep a web process running until this one is interrupted.

    While there is none, who connects waits: the socket stays open here.

    Raises
    ------
    EvaluatorFault
        If one after the other ends at once.
    """
    context = multiprocessing.get_context("spawn")
    failed = 0
    while True:
        process = context.Process(target=run_web, args=(config, listener, root), name="web")
        began = time.monotonic()
        process.start()
        try:
            process.join()
        finally:
            _end(process)
        failed = failed + 1 if time.monotonic() - began < SOON_S else 0
        if failed >= TRIES:
            raise EvaluatorFault(f"the web process ends at once, with code {process.exitcode}")
        log.error("the web process has ended with code %s; another is started", process.exitcode)


def _end(process: SpawnProcess) -> None:
    if process.is_alive():
        process.terminate()
        process.join(END_S)
    if process.is_alive():
        process.kill()
        process.join()
