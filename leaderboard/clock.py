"""What time it is: asked at the edges of a board, never where anything is scored."""

from collections.abc import Callable
from datetime import UTC, datetime

Clock = Callable[[], datetime]
"""Returns a time with its zone."""


def utc_now() -> datetime:
    """Return the time of this machine."""
    return datetime.now(UTC)
