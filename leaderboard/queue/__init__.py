"""The queue of a board: what waits, who works on it, and what has come of it."""

from .queue import Queue
from .quota import NO_QUOTA, Quota, QuotaError
from .work import FAULTS, LEASE, LOST, LostError, Work

__all__ = [
    "FAULTS",
    "LEASE",
    "LOST",
    "NO_QUOTA",
    "LostError",
    "Queue",
    "Quota",
    "QuotaError",
    "Work",
]
