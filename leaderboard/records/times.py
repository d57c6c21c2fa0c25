"""Times in words: always of one zone, which they name."""

from datetime import UTC, datetime


def utc_minute(at: datetime) -> str:
    """Return a time to the minute, such as ``2026-11-20 08:30 UTC``."""
    return f"{at.astimezone(UTC):%Y-%m-%d %H:%M} UTC"


def utc_second(at: datetime) -> str:
    """Return a time to the second, such as ``2026-11-20 08:30:15 UTC``."""
    return f"{at.astimezone(UTC):%Y-%m-%d %H:%M:%S} UTC"
