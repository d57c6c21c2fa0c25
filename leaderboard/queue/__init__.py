"""The queue of a board: jobs, quotas and workers."""

from colift.leaderboard.queue.attendance import LEASE, Attendance
from colift.leaderboard.queue.quota import NO_QUOTA, Quota, QuotaError
from colift.leaderboard.queue.submitting import Queue
from colift.leaderboard.queue.work import FAULTS, LOST, LostError, WorkerQueue

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
