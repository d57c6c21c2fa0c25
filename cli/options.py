"""Options that commands share: seeds, suites, worker processes and files to write."""

import os
from concurrent.futures import Executor
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Annotated, Final

import typer

from ..agents.errors import InputError
from ..benchmark.execution.connecting import dask_pool
from ..benchmark.execution.pool import JOBS, local_pool
from ..benchmark.suites.suite import Suite, make_suite, recorded_suite
from .remedies import opened

STANDARD: Final = "standard-v1"
"""The suite that is meant when none is named."""

DIGITS: Final = 12
"""Digits of the largest seed."""

MOST: Final = 100_000
"""Seeds in all: so many lifts can be in a result bundle."""

Jobs = Annotated[
    int | None,
    typer.Option(metavar="N", help=f"Worker processes; default: all cores, or what {JOBS} says."),
]
"""The option ``--jobs``."""


def seed_range(text: str) -> tuple[int, int]:
    """Return A and B of ``A:B``.

    Raises
    ------
    InputError
        If it is not two whole numbers, or they are too large or too far apart.
    """
    start, colon, stop = text.partition(":")
    if not (colon and start.isdecimal() and stop.isdecimal()):
        raise InputError(f"--seeds must be A:B with 0 <= A < B, got {text!r}")
    if len(start) > DIGITS or len(stop) > DIGITS:
        raise InputError(f"--seeds must have at most {DIGITS} digits, got {text!r:.80}")
    if int(stop) - int(start) > MOST:
        raise InputError(f"--seeds must be {MOST} seeds at most, got {text!r}")
    return int(start), int(stop)


def chosen_suite(name: str, seeds: str | None, recordings: Path | None) -> Suite:
    """Return a suite by name, with other seeds if any are given, or that of a file of recordings.

    Raises
    ------
    InputError
        If there is no such suite, or the file or the seeds cannot be used.
    """
    if recordings is None:
        suite = make_suite(name)
        return suite if seeds is None else suite.with_seeds(*seed_range(seeds))
    if seeds is not None:
        raise InputError("--seeds and --recordings exclude each other: a recording has no seed")
    return recorded_suite(recordings)


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
    return opened(dask_pool(dask), "--dask")


def write_output(path: Path | None, content: str) -> None:
    """Write what a command made into the file that was asked for, if any, and say so."""
    if path is not None:
        path.write_text(content)
        print(f"written: {path}")


def check_folder(option: str, folder: Path) -> None:
    """Make the folder that an option names, or refuse it, before any work is done.

    Raises
    ------
    InputError
        If it is a file, or cannot be made or written to.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{option}: {folder} cannot be a folder: {error.strerror}") from error
    if not os.access(folder, os.W_OK):
        raise InputError(f"{option}: {folder} is not writable")


def check_output(path: Path | None) -> None:
    """Refuse a file that cannot be written, before any work is done.

    Raises
    ------
    InputError
        If its folder is missing or not writable, or it is itself a folder.
    """
    if path is None:
        return
    if not path.parent.is_dir():
        raise InputError(f"cannot write {path}: there is no folder {path.parent}")
    if path.is_dir() or not os.access(path if path.exists() else path.parent, os.W_OK):
        raise InputError(f"cannot write {path}: it is a folder, or not writable")
