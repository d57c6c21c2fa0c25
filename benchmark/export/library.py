"""The libraries of the extra ``export``, imported on demand."""

import importlib
from typing import Any

from colift.base.errors import InputError
from colift.base.extras import how_to_install


def import_minari(module: str = "") -> Any:
    """Return Minari, or a module of it such as ``dataset.minari_storage``.

    Raises
    ------
    InputError
        If Minari, or h5py, with which it stores arrays, is not installed.
    """
    _imported("h5py", "Minari's files need h5py")
    return _imported(f"minari.{module}".rstrip("."), "Minari data sets need minari")


def import_pyarrow(module: str = "") -> Any:
    """Return pyarrow, or a module of it such as ``parquet``.

    Raises
    ------
    InputError
        If it is not installed.
    """
    return _imported(f"pyarrow.{module}".rstrip("."), "LeRobot data sets need pyarrow")


def _imported(module: str, need: str) -> Any:
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise InputError(f"{need}: {how_to_install('export')}") from error
