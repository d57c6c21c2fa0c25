"""The local pool of worker processes."""

import multiprocessing
import os
import signal
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager

from ..agents.errors import InputError


def default_jobs() -> int:
    """Return the number of processors this process may use."""
    return len(os.sched_getaffinity(0))


def _ignore_interrupt() -> None:
    """Leave Ctrl-C to the parent, which keeps what is finished."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


@contextmanager
def process_pool(jobs: int) -> Iterator[Executor]:
    """Yield a pool of ``jobs`` processes, forked from a server that has imported everything."""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["colift.benchmark.runner"])
    pool = ProcessPoolExecutor(jobs, mp_context=context, initializer=_ignore_interrupt)
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)


@contextmanager
def local_pool(jobs: int) -> Iterator[Executor | None]:
    """Yield a pool of ``jobs`` processes, or None for one job: then nothing needs a pool.

    Raises
    ------
    InputError
        If ``jobs`` is not positive.
    """
    if jobs < 1:
        raise InputError(f"--jobs must be at least 1, got {jobs}")
    if jobs == 1:
        yield None
    else:
        with process_pool(jobs) as pool:
            yield pool
