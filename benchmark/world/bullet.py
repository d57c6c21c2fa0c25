"""PyBullet, with the output of its C code discarded where the C library is GNU's."""

import ctypes
import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

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
