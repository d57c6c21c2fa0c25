"""What plays the episodes of a command: this machine's processes, or a Dask cluster."""

from concurrent.futures import Executor
from contextlib import AbstractContextManager
from typing import Annotated

import typer

from ..agents.errors import InputError
from ..benchmark.connecting import dask_pool
from ..benchmark.executors import JOBS, local_pool

Jobs = Annotated[
    int | None,
    typer.Option(metavar="N", help=f"Worker processes; default: all cores, or what {JOBS} says."),
]
"""The option ``--jobs``."""


def executor(jobs: int | None, dask: str | None) -> AbstractContextManager[Executor | None]:
    """Return what plays the episodes; None is this process.

    Parameters
    ----------
    jobs
        Number of processes; None is :func:`.default_jobs`.
    dask
        Address of a Dask scheduler.

    Raises
    ------
    InputError
        If both are given, or ``jobs`` is not positive.
    """
    if dask is None:
        return local_pool(jobs)
    if jobs is not None:
        raise InputError("--jobs and --dask exclude each other: a cluster has its own workers")
    return dask_pool(dask)
