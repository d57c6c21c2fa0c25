"""Line ends of a submission's text files: those of Unix, on whatever system it was packed.

Copies of a submission have these bytes, and its digest is theirs: what runs is what the digest
names.
"""

import re
from typing import Final

SUFFIXES: Final = (
    *(".cfg", ".csv", ".ini", ".json", ".md", ".py"),
    *(".pyi", ".rst", ".toml", ".txt", ".yaml", ".yml"),
)
"""Endings of the names of text files; all other files are taken byte by byte."""

LONGEST: Final = 16 * 2**20
"""Largest file that is read as text [bytes]: it is held in memory."""

_END: Final = re.compile(rb"\r+\n")


def is_text(path: str, size: int) -> bool:
    """Return whether a file is read as text, by its name and its size [bytes]."""
    return size <= LONGEST and path.lower().endswith(SUFFIXES)


def with_unix_line_ends(data: bytes) -> bytes:
    r"""Return a text file's bytes with ``\n`` for ``\r\n``; with a NUL it is no text, and stays.

    The result is a fixed point: it stays as it is if it is read again.
    """
    return data if b"\0" in data else _END.sub(b"\n", data)
