"""PyBullet where the C library is not GNU's: the output of its C code is not discarded.

On systems other than Linux it is imported in place of :mod:`.bullet`, which stays as it is, because
its code is in the digests of all suites.
"""

from collections.abc import Iterator
from contextlib import contextmanager

import pybullet

__all__ = ["pybullet", "silent"]


@contextmanager
def silent() -> Iterator[None]:
    """Do nothing: only the GNU C library lets a stream be exchanged."""
    yield
