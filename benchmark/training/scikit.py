"""scikit-learn, an optional dependency: imported on demand, fitted reproducibly."""

import contextlib
import importlib
import warnings
from collections.abc import Iterator
from typing import Any

from colift.base.errors import InputError
from colift.base.extras import how_to_install


def import_sklearn(module: str) -> Any:
    """Return a module of scikit-learn, such as ``mixture``.

    Raises
    ------
    InputError
        If scikit-learn is not installed.
    """
    try:
        importlib.import_module("sklearn")
        return importlib.import_module(f"sklearn.{module}")
    except ImportError as error:
        raise InputError(f"learning needs scikit-learn: {how_to_install('learn')}") from error


@contextlib.contextmanager
def reproducible_fit() -> Iterator[None]:
    """Limit a fit to one thread, so that the same data give the same bits; mute its warnings."""
    threads = importlib.import_module("threadpoolctl")
    with threads.threadpool_limits(1), warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # A ConvergenceWarning: a fit may end early.
        yield
