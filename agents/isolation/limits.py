"""What a sandboxed policy may use up."""

import math
from dataclasses import asdict, dataclass
from typing import Any, Final

from ..errors import InputError

MIB: Final = 2**20

OUTPUT: Final = 10_000
"""Characters of a policy's output that are kept: the last ones."""

REASON: Final = 500
"""Characters of a reason for a failure that are kept."""


@dataclass(frozen=True, kw_only=True)
class Limits:
    """Budgets of a policy in one episode. They are backstops: wall clock never enters a score."""

    memory: int = 2048 * MIB
    """Memory of all its processes together [bytes]."""
    processes: int = 64
    """Processes and threads at a time."""
    files: int = 256
    """Open files of a process."""
    file_size: int = 64 * MIB
    """Largest file, and all that its private /tmp and /dev/shm hold each [bytes]."""
    cpu_seconds: int = 120
    """Processor time of a process [s]."""
    start_seconds: float = 30.0
    """Wall time for import and constructor, and as much again for ``reset`` [s]."""
    step_seconds: float = 5.0
    """Wall time for an action [s]."""
    episode_seconds: float = 120.0
    """Wall time for all of an episode's answers, import included [s]."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If a limit is not a positive number.
        """
        for name, value in asdict(self).items():
            if not 0 < value < math.inf:
                raise InputError(f"limit {name} must be a positive number, got {value}")

    def plain(self) -> dict[str, Any]:
        """Return the limits by name, for another process."""
        return asdict(self)


LIMITS: Final = Limits()
