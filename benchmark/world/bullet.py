"""PyBullet, with the output of its C code discarded where the C library is GNU's."""

import ctypes
import importlib
import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from types import ModuleType
from typing import Any, Final

from colift.base.errors import InputError

_ONE_AT_A_TIME: Final = threading.Lock()


@contextmanager
def silent() -> Iterator[None]:
    """Discard the output of C code to stdout, on Linux.

    The C library's stream is exchanged, which the GNU C library allows, not the file descriptor, so
    that Python's own output, in any thread, and inherited descriptors are unaffected.
    """
    if sys.platform != "linux":
        yield
        return
    c = ctypes.PyDLL(None)
    c.fopen.restype = ctypes.c_void_p
    c.fclose.argtypes = [ctypes.c_void_p]
    with _ONE_AT_A_TIME:
        stdout = ctypes.c_void_p.in_dll(c, "stdout")
        kept, nowhere = stdout.value, c.fopen(os.fsencode(os.devnull), b"we")
        stdout.value = nowhere
        try:
            yield
        finally:
            stdout.value = kept
            c.fclose(nowhere)


class _PyBullet:
    """The module ``pybullet``, imported when it is first used.

    What needs the world's numbers alone, such as the twin, does without the engine.
    """

    def __getattr__(self, name: str) -> Any:
        """Return a function or constant, and keep it: the next access is that of an attribute."""
        found = getattr(_imported(), name)
        setattr(self, name, found)
        return found


@cache
def _imported() -> ModuleType:
    """Import the engine.

    PyBullet prints a line to stderr while it initialises the C++ library, which would keep an
    exchanged stream for good. Here the descriptor itself is redirected.
    """
    with _ONE_AT_A_TIME:
        kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 2)
        try:
            return importlib.import_module("pybullet")
        except ImportError as error:
            raise InputError(
                f"lifts in the engine need PyBullet, which cannot be imported: {error}; it has "
                "wheels for Python 3.11 to 3.13 (pip install pybullet, or pybullet-arm64). The "
                "twin needs none"
            ) from None
        finally:
            os.dup2(kept, 2)
            os.close(kept)
            os.close(nowhere)


pybullet: Final = _PyBullet()
"""The engine; an :class:`.InputError` at the first use if it cannot be imported."""
