"""Linear algebra on one thread: the number of threads changes the last bits of its results."""

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from threadpoolctl import ThreadpoolController

_Count = tuple[int, int]


class _Loaded(ctypes.Structure):
    """The system's ``struct dl_phdr_info``, which counts the libraries loaded and unloaded."""

    _fields_ = (
        ("address", ctypes.c_void_p),
        ("name", ctypes.c_char_p),
        ("headers", ctypes.c_void_p),
        ("header_count", ctypes.c_uint16),
        ("loaded", ctypes.c_ulonglong),
        ("unloaded", ctypes.c_ulonglong),
    )


_Visit: Final = ctypes.CFUNCTYPE(
    ctypes.c_int, ctypes.POINTER(_Loaded), ctypes.c_size_t, ctypes.py_object
)


def _note_counts(info: "ctypes._Pointer[_Loaded]", size: int, found: list[_Count]) -> int:
    if size >= ctypes.sizeof(_Loaded):
        found.append((info.contents.loaded, info.contents.unloaded))
    return 1  # The counts are the same for each library.


_FIRST: Final = _Visit(_note_counts)


def _library_count() -> _Count | None:
    """Return how many libraries this process has loaded and unloaded; None if unknown."""
    found: list[_Count] = []
    visit = getattr(ctypes.pythonapi, "dl_iterate_phdr", None)
    if visit is not None:
        visit(_FIRST, ctypes.py_object(found))
    return found[0] if found else None


_known: dict[_Count, ThreadpoolController] = {}
"""The libraries of linear algebra, by the count at which they were looked for."""


def _controller() -> ThreadpoolController:
    """Return the loaded libraries of linear algebra.

    They are searched again only after another library has been loaded: a search takes
    milliseconds, as long as a tenth of a lift.
    """
    count = _library_count()
    if count is None:
        return ThreadpoolController()
    if count not in _known:
        found = ThreadpoolController()
        _known.clear()
        _known[count] = found
    return _known[count]


@contextmanager
def one_thread() -> Iterator[None]:
    """Limit linear algebra to one thread, as in a sandbox: more threads change the last bits.

    Only libraries that are already loaded are limited.
    """
    with _controller().limit(limits=1):
        yield
