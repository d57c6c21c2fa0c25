"""PyBullet with the output of its C code discarded."""

import ctypes
import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

_C: Final = ctypes.PyDLL(None)
_C.fopen.restype = ctypes.c_void_p
_C.fclose.argtypes = [ctypes.c_void_p]
_ONE_AT_A_TIME: Final = threading.Lock()


@contextmanager
def silent() -> Iterator[None]:
    """Discard the output of C code to stdout.

    The C library's stream is exchanged, which the GNU C library allows, not the file descriptor, so
    that Python's own output, in any thread, and inherited descriptors are unaffected.
    """
    with _ONE_AT_A_TIME:
        stdout = ctypes.c_void_p.in_dll(_C, "stdout")
        kept, nowhere = stdout.value, _C.fopen(os.fsencode(os.devnull), b"we")
        stdout.value = nowhere
        try:
            yield
        finally:
            stdout.value = kept
            _C.fclose(nowhere)


# PyBullet prints a line to stderr while it initialises the C++ library, which would keep an
# exchanged stream for good. Here the descriptor itself is redirected.
_kept = os.dup(2)
_nowhere = os.open(os.devnull, os.O_WRONLY)
os.dup2(_nowhere, 2)
try:
    import pybullet
finally:
    os.dup2(_kept, 2)
    os.close(_kept)
    os.close(_nowhere)

__all__ = ["pybullet", "silent"]
