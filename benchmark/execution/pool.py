"""The local pool of worker processes."""

import contextlib
import multiprocessing
import os
import pickle
import queue
import signal
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from contextlib import contextmanager
from multiprocessing.connection import Connection
from typing import Any, Final, ParamSpec, TypeVar

from colift.base.errors import EvaluatorFault, InputError, error_text
from colift.benchmark.execution.processors import usable_processors

P = ParamSpec("P")
T = TypeVar("T")


JOBS: Final = "COLIFT_JOBS"
"""Environment variable with the default number of worker processes."""

MOST_JOBS: Final = 1024
"""Most worker processes on a machine; each takes some 100 MB."""


def default_jobs() -> int:
    """Return :data:`JOBS`, or :func:`.usable_processors`.

    Raises
    ------
    InputError
        If :data:`JOBS` is not a positive number.
    """
    asked = os.environ.get(JOBS, "")
    if not asked:
        return usable_processors()
    if not (asked.isascii() and asked.isdecimal() and int(asked) > 0):
        raise InputError(f"{JOBS} must be a whole number above 0, got {asked!r}")
    return int(asked)


def checked_jobs(jobs: int | None) -> int:
    """Return a number of worker processes; None is :func:`default_jobs`.

    Raises
    ------
    InputError
        If it is not positive, or too large.
    """
    if jobs is not None and jobs < 1:
        raise InputError(f"jobs must be at least 1, got {jobs}")
    if jobs is not None and jobs > MOST_JOBS:
        raise InputError(f"jobs must be at most {MOST_JOBS}, got {jobs}")
    return default_jobs() if jobs is None else jobs


class LocalPool(Executor):
    """Worker processes on this machine; if one dies, only its own call fails.

    In the standard library's pool the death of a worker fails all waiting calls and ends the pool,
    and its processes survive if this process is killed. Here each worker has a pipe of its own, and
    ends when that is closed.

    Parameters
    ----------
    jobs
        Number of processes.
    """

    def __init__(self, jobs: int) -> None:
        self.workers: Final = jobs
        """Number of processes."""
        self._threads = ThreadPoolExecutor(jobs)
        self._workers = [_Worker() for _ in range(jobs)]
        self._idle: queue.SimpleQueue[_Worker] = queue.SimpleQueue()
        for worker in self._workers:
            self._idle.put(worker)

    def submit(self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Schedule a call; its future raises an EvaluatorFault if the worker dies in it."""
        return self._threads.submit(self._call, fn, args, kwargs)

    def _call(self, fn: Callable[..., T], args: Any, kwargs: Any) -> T:
        call = pickle.dumps((fn, args, kwargs))
        worker = self._idle.get()
        try:
            result: T = worker.call(call)
        finally:
            self._idle.put(worker)
        return result

    def processes(self) -> list[int]:
        """Return the process ids of the workers that have been used."""
        found = (worker.process for worker in self._workers)
        return [process.pid for process in found if process is not None and process.pid]

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End the pool; with ``cancel_futures`` at once, without the results of running calls."""
        if cancel_futures:
            self._threads.shutdown(wait=False, cancel_futures=True)
            self._kill()
        self._threads.shutdown(wait=wait)
        if wait:
            self._kill()
            for worker in self._workers:
                worker.forget()

    def _kill(self) -> None:
        for worker in self._workers:
            worker.kill()


class _Worker:
    """A process that answers one call at a time; it is started at the first call."""

    def __init__(self) -> None:
        self.process: multiprocessing.process.BaseProcess | None = None
        self._ended = False

    def call(self, call: bytes) -> Any:
        """Return the result of a pickled call, or raise its error."""
        process = self._started() if self.process is None else self.process
        try:
            self._pipe.send_bytes(call)
            failed, outcome = pickle.loads(self._pipe.recv_bytes())
        except (EOFError, OSError) as error:
            self.forget()
            raise EvaluatorFault(f"a worker died: {_exit(process.exitcode)}") from error
        if failed:
            raise outcome
        return outcome

    def _started(self) -> multiprocessing.process.BaseProcess:
        if self._ended:
            raise EvaluatorFault("the pool of workers has ended")
        context = multiprocessing.get_context("forkserver")
        context.set_forkserver_preload(["colift.benchmark.execution.runner"])
        self._pipe, theirs = context.Pipe()
        process = context.Process(target=_serve, args=(theirs,))
        process.start()
        self.process = process
        theirs.close()
        if self._ended:
            process.kill()
        return process

    def kill(self) -> None:
        """Kill the process, whose results are no longer needed; may be called from any thread."""
        self._ended, process = True, self.process
        if process is not None:
            process.kill()

    def forget(self) -> None:
        """Wait for the end of the process, if there is one, and close the pipe to it."""
        if self.process is not None:
            self.process.join()
            self._pipe.close()
            self.process = None


def _serve(pipe: Connection) -> None:
    """Answer calls until the pipe is closed; worker processes run this."""
    # Ctrl-C is handled by the parent, which keeps the finished episodes.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with contextlib.suppress(EOFError, OSError):
        while True:
            pipe.send_bytes(_outcome(pipe.recv_bytes()))


def _outcome(call: bytes) -> bytes:
    """Return whether a call failed, and its result or error, pickled."""
    try:
        fn, args, kwargs = pickle.loads(call)
        return pickle.dumps((False, fn(*args, **kwargs)))
    except Exception as error:
        with contextlib.suppress(Exception):
            data = pickle.dumps((True, error))
            pickle.loads(data)
            return data
        return pickle.dumps((True, EvaluatorFault(error_text(error))))
    except BaseException as error:
        # A policy may raise SystemExit or KeyboardInterrupt.
        return pickle.dumps((True, EvaluatorFault(error_text(error))))


def _exit(code: int | None) -> str:
    """Return an exit code in words."""
    if code is not None and code < 0:
        with contextlib.suppress(ValueError):
            return f"killed by {signal.Signals(-code).name}"
    return f"exit code {code}"


@contextmanager
def process_pool(jobs: int) -> Iterator[LocalPool]:
    """Yield a pool of ``jobs`` processes, forked from a server that has imported everything."""
    pool = LocalPool(jobs)
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)


@contextmanager
def local_pool(jobs: int | None) -> Iterator[Executor | None]:
    """Yield a pool of ``jobs`` processes, or None for one job, which needs no pool.

    ``jobs`` of None is :func:`default_jobs`.

    Raises
    ------
    InputError
        If ``jobs`` is not positive, or too large.
    """
    jobs = checked_jobs(jobs)
    if jobs == 1:
        yield None
    else:
        with process_pool(jobs) as pool:
            yield pool
