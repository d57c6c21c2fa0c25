"""PyBullet, without what its C code prints."""

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
    """Discard what C code prints to stdout.

    The C library's stream is exchanged, which the GNU C library allows, and not the file
    descriptor: what Python prints, in any thread, and what child processes inherit stays as it is.
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


# The line that PyBullet prints to stderr when it loads comes together with the initialisation of
# the C++ library, which would keep an exchanged stream for good: here the descriptor is re-pointed.
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
