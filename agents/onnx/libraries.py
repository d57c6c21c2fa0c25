"""The libraries ``onnx`` and ``onnxruntime``, optional dependencies."""

import importlib
import importlib.util
import os
from typing import Any, Final

from colift.base.errors import InputError
from colift.base.extras import how_to_install

NAMES: Final = ("onnx", "onnxruntime")
"""The libraries."""

NO_TELEMETRY: Final = "ORT_DISABLE_TELEMETRY"
"""The variable that keeps onnxruntime from reports to its maker: since 1.29, importing it starts a
thread that sends them, and writes an identifier of the machine into the user's cache. Colift sets
it to 1, unless it is set."""


def require_libraries() -> None:
    """Raise an InputError if one of the libraries is not installed; they are not imported."""
    for name in NAMES:
        if importlib.util.find_spec(name) is None:
            raise _missing(name)


def import_library(name: str) -> Any:
    """Return a module of onnx or onnxruntime.

    Parameters
    ----------
    name
        Its full name, such as ``onnx.numpy_helper``.

    Raises
    ------
    InputError
        If the library is not installed.
    """
    os.environ.setdefault(NO_TELEMETRY, "1")
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise _missing(name.partition(".")[0]) from error


def _missing(name: str) -> InputError:
    return InputError(f"a policy in an ONNX file needs {name}: {how_to_install('onnx')}")
