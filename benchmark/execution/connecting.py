"""Connection to a Dask cluster, if all workers would give the same results as this machine."""

import asyncio
import logging
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Final

from colift.base.errors import InputError, error_text
from colift.base.extras import how_to_install
from colift.benchmark.execution.cluster import Cluster
from colift.benchmark.execution.provenance import COLIFT, check_same_origin, origin

CONNECT_SECONDS: Final = 10.0
"""Time limit for the scheduler to answer, and for a first worker [s]."""

LOGGER: Final = "distributed.client"
"""Logger that prints a traceback for a lost scheduler; here an error is raised instead."""


@contextmanager
def dask_pool(address: str) -> Iterator[Cluster]:
    """Yield the Dask cluster of a scheduler as an executor.

    Parameters
    ----------
    address
        Address of the scheduler, such as ``tcp://host:8786``.

    Raises
    ------
    InputError
        If Dask is not installed, there is no scheduler at the address, it has no worker, or
        results would depend on the worker: the workers' colift is not this one, or their
        platforms are not all the same.
    """
    try:
        from distributed import Client
    except ImportError:
        raise InputError(f"Dask is not installed: {how_to_install('cluster')}") from None
    _reach(address)
    with (
        _quiet(logging.getLogger(LOGGER)),
        Client(address, timeout=CONNECT_SECONDS, set_as_default=False) as client,  # type: ignore[no-untyped-call]
    ):
        try:
            client.wait_for_workers(1, timeout=CONNECT_SECONDS)
        except TimeoutError:
            raise InputError(
                f"the Dask scheduler {address} has no worker; start some: "
                f"dask worker {address} --nworkers auto --nthreads 1"
            ) from None
        with Cluster(client, address, _agreed(client, address)) as cluster:
            yield cluster


def _reach(address: str) -> None:
    """Raise an InputError if there is no scheduler: a client without one leaves threads behind."""
    try:
        kind = asyncio.run(asyncio.wait_for(_kind(address), CONNECT_SECONDS))
    except Exception as error:
        raise InputError(
            f"no Dask scheduler answers at {address!r} ({error_text(error)}); "
            "the address should be such as tcp://host:8786"
        ) from error
    if kind != "Scheduler":
        raise InputError(f"{address} is the address of a Dask {kind}; name the scheduler")


async def _kind(address: str) -> str:
    """Return the kind of server at an address: ``Scheduler``, ``Worker`` or ``Nanny``."""
    from distributed import rpc
    from distributed.security import Security

    secured = Security().get_connection_args("client")  # type: ignore[no-untyped-call]
    server: Any = rpc(address, timeout=CONNECT_SECONDS, connection_args=secured)  # type: ignore[no-untyped-call]
    async with server:
        return str((await server.identity())["type"])


@contextmanager
def _quiet(logger: logging.Logger) -> Iterator[None]:
    """Silence a logger."""
    before = logger.level
    logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        logger.setLevel(before)


def _agreed(client: Any, address: str) -> dict[str, str]:
    """Return the origin that all workers share; raise an InputError for a difference."""
    found = client.run(origin, on_error="return")
    agreed: dict[str, str] | None = None
    for worker, answer in found.items():
        if isinstance(answer, OSError):
            continue  # It has just died; its successor is compared when it works.
        if isinstance(answer, BaseException):
            raise InputError(f"Dask worker {worker} cannot run colift: {error_text(answer)}")
        check_same_origin(answer, {COLIFT: origin()[COLIFT]}, f"on worker {worker}", "here")
        agreed = agreed or answer
        check_same_origin(answer, agreed, f"on worker {worker}", "on another worker")
    if agreed is None:
        raise InputError(f"every worker of the Dask scheduler {address} has just died")
    return agreed
