"""The loop's clock in the laboratory."""

import time
from typing import Final

from colift.agents.hardware.operator import StopButton

_CLOCK: Final = getattr(time, "CLOCK_BOOTTIME", time.CLOCK_MONOTONIC)

_ASLEEP: Final = time.clock_gettime(_CLOCK) - time.monotonic()
"""Time for which the machine was suspended before this process began [s]."""


def awake_or_asleep() -> float:
    """Return the monotonic clock, which on Linux goes on while the machine is suspended [s].

    ``time.monotonic`` stands still meanwhile; both are equal until the first suspension.
    """
    return time.clock_gettime(_CLOCK) - _ASLEEP


class MonotonicClock:
    """The system's monotonic clock; waiting ends early when the stop button is pressed."""

    def __init__(self, button: StopButton | None = None) -> None:
        self._button = button or StopButton()

    def now(self) -> float:
        """Return the time [s]."""
        return awake_or_asleep()

    def wait_until(self, when: float) -> str | None:
        """Wait until a time; return the reason if the stop button was pressed, or None."""
        while (left := when - self.now()) > 0:
            if self._button.wait(left):
                break
        return self._button.reason
