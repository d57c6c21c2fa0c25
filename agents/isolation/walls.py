"""Walls: what is around a policy in its cell."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

FRESH: Final = ("/tmp", "/dev/shm")
"""Directories that a cell with namespaces has for itself, empty at first."""


@dataclass(frozen=True, kw_only=True)
class Walls:
    """What is around a policy."""

    namespaces: str
    """``root``: made by the superuser; ``user``: by anybody; empty: none."""
    landlock: bool
    seccomp: bool
    readable: tuple[Path, ...]
    """What it may read."""
    hidden: tuple[Path, ...]
    """What of that is to be covered."""
    mounted: bool
    """Whether the mounts show that and no more."""
    folder: Path | None
    """Its folder, where it starts."""
    scratch: Path | None
    """Where it may write if it has no private /tmp."""
    limits: dict[str, Any]
    """See :class:`.limits.Limits`."""
