"""The loop's clock in the laboratory."""

import time

from .operator import StopButton


class MonotonicClock:
    """The system's monotonic clock; waiting ends early when the stop button is pressed."""

    def __init__(self, button: StopButton | None = None) -> None:
        self._button = button or StopButton()

    def now(self) -> float:
        """Return the time [s]."""
        return time.monotonic()

    def wait_until(self, when: float) -> str | None:
        """Wait until a time; return the reason if the stop button was pressed, or None."""
        while (left := when - time.monotonic()) > 0:
            if self._button.wait(left):
                break
        return self._button.reason
