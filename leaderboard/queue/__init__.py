"""The queue of a board: jobs, quotas and workers."""

from .queue import Queue
from .quota import NO_QUOTA, Quota, QuotaError
from .work import FAULTS, LEASE, LOST, LostError, WorkerQueue

__all__ = [
    "FAULTS",
    "LEASE",
    "LOST",
    "NO_QUOTA",
    "LostError",
    "Queue",
    "Quota",
    "QuotaError",
    "WorkerQueue",
]
