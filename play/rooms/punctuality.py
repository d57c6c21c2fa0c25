"""Lateness of the frames of a live lift, and its consequence for the lift."""

from dataclasses import dataclass, field
from typing import Final

MARKED_S: Final = 0.050
"""A gap longer than this marks a lift [s]."""

VOID_S: Final = 0.150
"""A gap longer than this makes a lift void [s]: the person saw the table stop."""

VOID_SUM_S: Final = 0.300
"""Sum of marking gaps above which a lift is void [s]."""


@dataclass(kw_only=True)
class Punctuality:
    """Lateness of frames: a person's timing is meaningful only if simulated time is real time.

    A late frame is made at once, together with those that have become due; the lateness of the
    first of them is a gap.
    """

    period: float
    """Time of a frame [s]."""
    late: list[float] = field(default_factory=list)
    """Lateness of the beginning of each frame [s]."""
    worst: float = 0.0
    """Longest gap [s]."""
    total: float = 0.0
    """Sum of the gaps that mark the lift [s]."""

    def count(self, lateness: float, caught_up: int) -> None:
        """Count a wake-up that was ``lateness`` [s] late and made ``caught_up`` frames."""
        self.late += [lateness - i * self.period for i in range(caught_up)]
        self.worst = max(self.worst, lateness)
        if lateness > MARKED_S:
            self.total += lateness

    @property
    def frames(self) -> int:
        """Number of frames that were begun more than one frame late."""
        return sum(late > self.period for late in self.late)

    @property
    def marked(self) -> bool:
        """Whether the lift counts, but with a mark."""
        return self.worst > MARKED_S

    @property
    def void(self) -> bool:
        """Whether the lift does not count."""
        return self.worst > VOID_S or self.total > VOID_SUM_S

    def __str__(self) -> str:
        return (
            f"the table stood still for up to {1000 * self.worst:.0f} ms, and for "
            f"{1000 * self.total:.0f} ms in all"
        )
