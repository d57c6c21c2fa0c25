"""A Dask cluster as an executor, and calls on their way to its workers."""

import asyncio
import hashlib
import io
import pickle
import threading
import uuid
from collections.abc import Callable, Mapping
from concurrent.futures import CancelledError, Executor, Future
from contextlib import suppress
from typing import Any, Final, ParamSpec, TypeVar

from colift.base.errors import EvaluatorFault
from colift.benchmark.execution.provenance import check_same_origin, origin

LARGE: Final = 2**16
"""Size from which a value is sent once, separately from the calls that contain it [bytes]."""

_turn: Final = threading.Lock()


def parcel(
    fn: Callable[..., Any], args: Any, kwargs: Any, send: Callable[[bytes], Any]
) -> tuple[bytes, dict[str, Any]]:
    """Return a pickled call without its large values, and the large values by their hashes.

    Parameters
    ----------
    fn, args, kwargs
        The call.
    send
        Sends a large value, and returns its future on the cluster.
    """
    from cloudpickle import Pickler

    large: dict[str, Any] = {}

    class Small(Pickler):  # type: ignore[misc]
        def persistent_id(self, value: Any) -> str | None:
            if type(value) is not bytes or len(value) < LARGE:
                return None
            digest = hashlib.sha256(value).hexdigest()
            large[digest] = send(value)
            return digest

    data = io.BytesIO()
    Small(data).dump((fn, args, kwargs))
    return data.getvalue(), large


def call(data: bytes, large: Mapping[str, bytes], wanted: Mapping[str, str]) -> Any:
    """Return the result of a call that :func:`parcel` has pickled; workers run this.

    Calls take turns: the engine and the policies may have state that belongs to their process, and
    a worker of Dask's can have many threads.

    Raises
    ------
    InputError
        If the origin of this worker is not the wanted one.
    """
    check_same_origin(origin(), wanted, "on a worker that has joined", "on the others")

    class Whole(pickle.Unpickler):
        def persistent_load(self, digest: str) -> bytes:
            return large[digest]

    with _turn:
        fn, args, kwargs = Whole(io.BytesIO(data)).load()
        return fn(*args, **kwargs)


P = ParamSpec("P")
T = TypeVar("T")

LONELY_SECONDS: Final = 60.0
"""Longest time without any worker during a run [s]: Dask restarts workers that die."""

WATCH_SECONDS: Final = 0.2
"""Period of the checks that the scheduler is alive [s]."""


class Cluster(Executor):
    """The workers of a Dask cluster; see :func:`.connecting.dask_pool`.

    Dask would retry a call whose worker died. Here the future fails instead, and the run decides
    whether to try again. Dask may also wait forever for results that were lost with the scheduler.
    Here every future then fails, and no more calls are accepted.

    Parameters
    ----------
    client
        Dask's client, connected.
    address
        Address of its scheduler.
    origin
        The :func:`.origin` of every worker.
    """

    shares_files: Final = False
    """Policies must be packaged: the workers may be on machines without this one's files."""

    def __init__(self, client: Any, address: str, origin: Mapping[str, str]) -> None:
        self._client = client
        self._address = address
        self.origin = dict(origin)
        """The :func:`.origin` of every worker."""
        self.idle_threads = sum(threads - 1 for threads in client.nthreads().values())
        """Idle threads of the workers: all but one of each worker."""
        self._waiting: dict[str, tuple[Any, Future[Any]]] = {}
        self._large: dict[bytes, Any] = {}
        self._alive: set[str] = set()
        client.subscribe_topic("all", self._heard)
        self._alive |= set(client.scheduler_info(n_workers=-1)["workers"])
        self._lost, self._ended = threading.Event(), threading.Event()
        self._watch = threading.Thread(target=self._watch_scheduler, daemon=True)
        self._watch.start()

    @property
    def workers(self) -> int:
        """Number of workers now: each plays one batch at a time."""
        return len(self._alive)

    def submit(self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Schedule a call; its future raises an EvaluatorFault if the worker dies in it."""
        if self._lost.is_set() or self._client.status != "running":
            raise self._loss()
        if not self._alive:
            self._wait_for_workers()
        data, large = parcel(fn, args, kwargs, self._sent)
        key = f"colift-{uuid.uuid4().hex}"
        waiting: Future[T] = Future()
        future = self._client.submit(call, data, large, self.origin, key=key, pure=False)
        self._waiting[key] = future, waiting
        future.add_done_callback(self._finished)
        waiting.add_done_callback(lambda _: self._waiting.pop(key, None))
        return waiting

    def _sent(self, value: bytes) -> Any:
        """Return the future of a large value; Dask repeats the call if a worker with it dies."""
        import dask

        digest = hashlib.sha256(value).digest()
        if digest not in self._large:
            with dask.config.set({"distributed.admin.large-graph-warning-threshold": "1GB"}):
                self._large[digest] = self._client.submit(bytes, value, pure=False)
        return self._large[digest]

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End the executor; the cluster goes on."""
        self._ended.set()
        if wait:
            self._watch.join()

    def _watch_scheduler(self) -> None:
        """Fail the waiting calls if the scheduler is lost, or if no worker has joined."""
        lonely = 0.0
        while not self._ended.wait(WATCH_SECONDS):
            if self._client.status != "running":
                self._lost.set()
            lonely = 0.0 if self._alive else lonely + WATCH_SECONDS
            if self._lost.is_set() or lonely > LONELY_SECONDS:
                for key in list(self._waiting):
                    self._settle(key, error=self._loss())

    def _loss(self) -> EvaluatorFault:
        if self._lost.is_set() or self._client.status != "running":
            return EvaluatorFault(f"lost the Dask scheduler {self._address}")
        return EvaluatorFault(
            f"the Dask scheduler {self._address} had no worker for {LONELY_SECONDS:.0f} s"
        )

    def _finished(self, future: Any) -> None:
        try:
            self._settle(future.key, self._result(future))
        except (CancelledError, asyncio.CancelledError):
            self._settle(future.key, error=self._loss())
        except Exception as error:
            self._settle(future.key, error=error)

    def _result(self, future: Any) -> Any:
        """Return the result of a call, or raise what it raised, unless the scheduler is lost."""
        while True:
            try:
                return future.result(timeout=WATCH_SECONDS)
            except TimeoutError:
                if future.status == "error" or self._lost.is_set():
                    raise

    def _settle(self, key: str, outcome: Any = None, error: Exception | None = None) -> None:
        """Settle the call that waits for a key, if any; the cluster then forgets the key."""
        _, waiting = self._waiting.pop(key, (None, None))
        if waiting is None or not waiting.set_running_or_notify_cancel():
            return
        if error is None:
            waiting.set_result(outcome)
        else:
            waiting.set_exception(error)

    def _heard(self, event: tuple[float, Mapping[str, Any]]) -> None:
        """Handle an event of the scheduler."""
        _, message = event
        if message.get("action") == "add-worker":
            self._alive.add(message["worker"])
        elif message.get("action") == "remove-worker":
            worker = message["worker"]
            self._alive.discard(worker)
            for key in message["processing-tasks"]:
                self._settle(key, error=EvaluatorFault(f"the worker {worker} died"))

    def _wait_for_workers(self) -> None:
        with suppress(TimeoutError):
            self._client.wait_for_workers(1, timeout=LONELY_SECONDS)
            return
        raise self._loss()
