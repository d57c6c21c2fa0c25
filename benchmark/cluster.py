"""A Dask cluster as an executor."""

import asyncio
import hashlib
import uuid
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import CancelledError, Executor, Future
from contextlib import contextmanager, suppress
from typing import Any, Final, ParamSpec, TypeVar

from ..agents.errors import EvaluatorFault, InputError, told
from .origin import COLIFT, compare, origin
from .parcels import call, parcel

P = ParamSpec("P")
T = TypeVar("T")

CONNECT_SECONDS: Final = 10.0
"""How long a scheduler may take to answer, and a first worker to be there [s]."""

LONELY_SECONDS: Final = 60.0
"""How long a cluster may be without any worker during a run [s]: one that died is started anew."""


class Cluster(Executor):
    """The workers of a Dask cluster; see :func:`dask_pool`.

    Dask would try a task whose worker died again by itself. Here its future fails, so that the run
    knows of it and decides.
    """

    def __init__(self, client: Any, address: str) -> None:
        self._client = client
        self._address = address
        self.origin = _agreed(client, address)
        """What :func:`.origin` is on every worker."""
        self._waiting: dict[str, tuple[Any, Future[Any]]] = {}
        self._large: dict[bytes, Any] = {}
        self._workers: set[str] = set()
        client.subscribe_topic("all", self._heard)
        self._workers |= set(client.scheduler_info(n_workers=-1)["workers"])

    def submit(self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Schedule a call; its future raises an EvaluatorFault if the worker dies in it."""
        if self._client.status != "running":
            raise EvaluatorFault(f"lost the Dask scheduler {self._address}")
        if not self._workers:
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
        """Return a large value on the cluster: computed there, it is not lost with a worker."""
        import dask

        digest = hashlib.sha256(value).digest()
        if digest not in self._large:
            with dask.config.set({"distributed.admin.large-graph-warning-threshold": "1GB"}):
                self._large[digest] = self._client.submit(bytes, value, pure=False)
        return self._large[digest]

    def _finished(self, future: Any) -> None:
        try:
            self._settle(future.key, future.result())
        except (CancelledError, asyncio.CancelledError):
            lost = EvaluatorFault(f"lost the Dask scheduler {self._address}")
            self._settle(future.key, error=lost)
        except Exception as error:
            self._settle(future.key, error=error)

    def _settle(self, key: str, outcome: Any = None, error: Exception | None = None) -> None:
        """Give what waits for a key its outcome, if it still waits; the cluster forgets the key."""
        _, waiting = self._waiting.pop(key, (None, None))
        if waiting is None or not waiting.set_running_or_notify_cancel():
            return
        if error is None:
            waiting.set_result(outcome)
        else:
            waiting.set_exception(error)

    def _heard(self, event: tuple[float, Mapping[str, Any]]) -> None:
        """Take note of an event of the scheduler's."""
        _, said = event
        worker = said.get("worker")
        if said.get("action") == "add-worker":
            self._workers.add(worker)
        elif said.get("action") == "remove-worker":
            self._workers.discard(worker)
            for key in said["processing-tasks"]:
                self._settle(key, error=EvaluatorFault(f"the worker {worker} died"))

    def _wait_for_workers(self) -> None:
        with suppress(TimeoutError):
            self._client.wait_for_workers(1, timeout=LONELY_SECONDS)
            return
        raise EvaluatorFault(
            f"the Dask scheduler {self._address} had no worker for {LONELY_SECONDS:.0f} s"
        )


@contextmanager
def dask_pool(address: str) -> Iterator[Cluster]:
    """Yield the Dask cluster of a scheduler as an executor.

    Parameters
    ----------
    address
        Of the scheduler, such as ``tcp://host:8786``.

    Raises
    ------
    InputError
        If Dask is not installed, there is no scheduler at the address, it has no worker, or
        results would depend on who computes them: the workers' colift is not this one, or their
        platforms are not all the same.
    """
    try:
        from distributed import Client
    except ImportError:
        raise InputError("--dask needs Dask: pip install 'colift[cluster]'") from None
    try:
        client: Any = Client(address, timeout=CONNECT_SECONDS, set_as_default=False)  # type: ignore[no-untyped-call]
    except Exception as error:
        raise InputError(
            f"--dask {address}: no Dask scheduler answers ({told(error)}); "
            "it should be such as tcp://host:8786"
        ) from error
    with client:
        try:
            client.wait_for_workers(1, timeout=CONNECT_SECONDS)
        except TimeoutError:
            raise InputError(
                f"--dask {address}: the scheduler has no worker; start some: "
                f"dask worker {address} --nworkers auto --nthreads 1"
            ) from None
        yield Cluster(client, address)


def _agreed(client: Any, address: str) -> dict[str, str]:
    """Return what all workers come from, or raise an InputError that names a difference."""
    found = client.run(origin, on_error="return")
    agreed: dict[str, str] | None = None
    for worker, said in found.items():
        if isinstance(said, OSError):
            continue  # It has just died; the next one is looked at when it works.
        if isinstance(said, BaseException):
            raise InputError(f"--dask {address}: worker {worker} cannot run colift: {told(said)}")
        compare(said, {COLIFT: origin()[COLIFT]}, f"worker {worker}", "here")
        agreed = agreed or said
        compare(said, agreed, f"worker {worker}", "another worker")
    if agreed is None:
        raise InputError(f"--dask {address}: every worker has just died")
    return agreed
