"""Priorities of threads: the frames of a lift first, then their relay to the pages."""

import contextlib
import os
from typing import Final

TABLE: Final = 2
"""Priority of the frames of a lift: nothing must stop the table."""

RELAY: Final = 1
"""Priority of the relay of frames to the pages."""

ORDINARY: Final = 0
"""Priority of all other work, such as that of a browser on the same machine."""


def take_turn(priority: int) -> None:
    """Let this thread run before those of a lower priority, if the system permits it.

    Processes and threads that this thread starts, such as that of a submitted policy, are ordinary.
    """
    if not hasattr(os, "sched_setscheduler"):
        return
    kind = os.SCHED_RR | os.SCHED_RESET_ON_FORK if priority else os.SCHED_OTHER
    if os.sched_getscheduler(0) != kind:
        with contextlib.suppress(PermissionError):
            os.sched_setscheduler(0, kind, os.sched_param(priority))
