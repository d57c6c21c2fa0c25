"""The episodes that a command's options ask for."""

from pathlib import Path

from ..agents.errors import InputError
from ..benchmark.suite import Suite, make_suite, recorded_suite
from .seeds import seed_range


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
