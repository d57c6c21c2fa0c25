"""Total time for which the hands were held in the last seconds, and its limit."""

from collections import deque
from typing import Final

LIMIT: Final = 1.0
"""Longest total hold in any :data:`WINDOW` before the trial is stopped [s]."""

WINDOW: Final = 5.0
"""Time over which holds add up [s]: more than a fifth of a lift is too much."""


class Holds:
    """Sum of the periods in which the hands were held, or that were skipped."""

    def __init__(self) -> None:
        self._steps: deque[tuple[float, bool]] = deque()

    def step(self, now: float, *, held: bool) -> float:
        """Add a step; return the total hold of the last seconds [s].

        A held step counts until the next one begins.
        """
        self._steps.append((now, held))
        while self._steps[0][0] < now - WINDOW:
            self._steps.popleft()
        total, before = 0.0, now
        for time, was_held in reversed(self._steps):
            total += (before - time) * was_held
            before = time
        return total
