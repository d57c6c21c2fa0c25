"""The processors that this process may use: its affinity, and the quota of its control groups."""

import contextlib
import math
import os
from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from typing import Final

ROOT: Final = Path("/")
"""The root of the file system that describes control groups."""


def usable_processors() -> int:
    """Return the number of processors on which this process may run, and whose time it may use.

    A container limits the time by a quota (``docker run --cpus=2``), not the processors.
    """
    affinity = getattr(os, "sched_getaffinity", None)  # Only Linux has it.
    count = len(affinity(0)) if affinity else os.cpu_count() or 1
    quota = processor_quota()
    return count if quota is None else max(1, min(count, math.ceil(quota)))


def processor_quota(root: Path = ROOT) -> float | None:
    """Return the processors' time that a second has for this process [s]; None if unlimited.

    It is the least of the quotas of its control groups, of version 1 and 2, and of all groups
    around them.

    Parameters
    ----------
    root
        Where ``/proc`` and the control groups are mounted.
    """
    quotas: list[float] = []
    with contextlib.suppress(OSError, ValueError, IndexError):  # No Linux, or no control groups.
        for folder in _groups(root):
            quotas += _quotas(folder)
    return min(quotas, default=None)


def _groups(root: Path) -> Iterator[Path]:
    """Yield the folders of this process's groups that can limit its time, and those above them."""
    own: dict[str, PurePosixPath] = {}
    for line in (root / "proc/self/cgroup").read_text().splitlines():
        _, controllers, path = line.split(":", 2)
        own |= {each: PurePosixPath(path) for each in controllers.split(",")}
    for line in (root / "proc/self/mountinfo").read_text().splitlines():
        before, _, after = line.partition(" - ")
        top, place = before.split()[3:5]
        kind, _, options = after.split(" ", 2)
        controller = {"cgroup2": "", "cgroup": "cpu"}.get(kind)
        if controller not in own or (kind == "cgroup" and controller not in options.split(",")):
            continue
        mounted = root / place.lstrip("/")
        group = own[controller]
        # In a container the mount may show its own group as the top, or begin somewhere above it.
        inner = group.relative_to(top) if group.is_relative_to(top) else PurePosixPath()
        yield from (mounted / each for each in (inner, *inner.parents))


def _quotas(folder: Path) -> Iterator[float]:
    """Yield the quota of a group, if it has one."""
    with contextlib.suppress(FileNotFoundError):
        quota, period = (folder / "cpu.max").read_text().split()
        if quota != "max":
            yield int(quota) / int(period)
    with contextlib.suppress(FileNotFoundError):
        limited = int((folder / "cpu.cfs_quota_us").read_text())
        if limited > 0:
            yield limited / int((folder / "cpu.cfs_period_us").read_text())
