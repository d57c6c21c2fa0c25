"""The queue of a board: jobs, quotas and workers."""

from .attendance import LEASE, Attendance
from .queue import Queue
from .quota import NO_QUOTA, Quota, QuotaError
from .work import FAULTS, LOST, LostError, WorkerQueue

__all__ = [
    "FAULTS",
    "LEASE",
    "LOST",
    "NO_QUOTA",
    "Attendance",
    "LostError",
    "Queue",
    "Quota",
    "QuotaError",
    "WorkerQueue",
]
