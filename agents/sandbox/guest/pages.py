"""Pages of files that are kept in memory, so that reading one leaves no trace.

A page of a file that is first read in a lift would stay in memory, and another process could tell.
"""

import os
from collections import defaultdict
from collections.abc import Iterator
from typing import Final, NamedTuple

from colift.agents.sandbox.guest import linux


class Mapping(NamedTuple):
    """A part of a process's memory that is mapped from a file."""

    path: str
    begin: int
    """Place in the file [bytes]."""
    end: int
    device: str
    """Device of the file system, as ``major:minor``."""
    shared: bool
    """Whether what is written there is shared."""


def mappings(maps: bytes) -> Iterator[Mapping]:
    """Yield the mappings of files in a process's ``/proc/PID/maps``."""
    for line in os.fsdecode(maps).splitlines():
        addresses, rights, offset, device, inode, *path = line.split(maxsplit=5)
        if inode != "0":
            begin, end = (int(each, 16) for each in addresses.split("-"))
            place = int(offset, 16)
            shared = rights[1] == "w" and rights[3] == "s"
            yield Mapping(path[0], place, place + end - begin, device, shared)


class Pages:
    """Pages that are in memory for as long as this process lives, locked where that is allowed.

    Where it is not, they leave memory only if the machine has too little.
    """

    def __init__(self) -> None:
        self._kept: Final[dict[str, list[tuple[int, int]]]] = defaultdict(list)

    def keep(self, mapping: Mapping) -> None:
        """Keep the pages of a mapping; raise OSError if its file cannot be opened by its path."""
        spans = self._kept[mapping.path]
        if any(begin <= mapping.begin and mapping.end <= end for begin, end in spans):
            return
        file = os.open(mapping.path, os.O_RDONLY)
        try:
            size = min(mapping.end, os.fstat(file).st_size) - mapping.begin
            if size > 0:
                linux.keep_in_memory(file, mapping.begin, size)
        finally:
            os.close(file)
        spans.append((mapping.begin, mapping.end))
