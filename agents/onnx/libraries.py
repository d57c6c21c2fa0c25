"""The libraries ``onnx`` and ``onnxruntime``, optional dependencies."""

import importlib
from typing import Any

from ..errors import InputError
from ..extras import how_to_install


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
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise InputError(
            f"a policy in an ONNX file needs {name.partition('.')[0]}: {how_to_install('onnx')}"
        ) from error
