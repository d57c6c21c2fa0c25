"""The spare time of this machine for another live lift, whose table must not stand still."""

import asyncio
import os
import time
from pathlib import Path
from typing import Final

SPAN_S: Final = 0.3
"""Duration of a measurement [s]."""

TICK_S: Final = 0.010
"""Time of a frame of a lift [s]."""

LATE_S: Final = 0.005
"""A machine is busy if more than a tenth of the ticks are later than this [s]."""

FREE_CORES: Final = 0.25
"""Number of cores that must be idle: a room takes a tenth of that, and its browser may run here."""


async def busy() -> str | None:
    """Return a sentence on why this machine has no time for another room, or None if it has."""
    loop = asyncio.get_running_loop()
    began, idle = time.monotonic(), idle_seconds()
    late, due = [], loop.time()
    while due < began + SPAN_S:
        due += TICK_S
        await asyncio.sleep(due - loop.time())
        late.append(loop.time() - due)
    now_idle = idle_seconds()
    free = None
    if idle is not None and now_idle is not None:
        free = (now_idle - idle) / (time.monotonic() - began)
    return busy_reason(late, free)


def busy_reason(late: list[float], free: float | None) -> str | None:
    """Return a sentence on why a machine is busy, from late ticks [s] and idle cores, or None."""
    usually = sorted(late)[len(late) * 9 // 10]
    if usually > LATE_S:
        return (
            "This machine is busy with other work: a timer is late by "
            f"{1000 * usually:.0f} ms, and the table would jerk."
        )
    if free is not None and free < FREE_CORES:
        return "This machine is busy with other work: no core is free, and the table would jerk."
    return None


def idle_seconds() -> float | None:
    """Return the time that all cores together have been idle [s]; None if it is not known.

    Processes of lower priority (nice) count as idle, since they yield.
    """
    try:
        fields = Path("/proc/stat").read_text().partition("\n")[0].split()
        return sum(int(fields[i]) for i in (2, 4, 5)) / os.sysconf("SC_CLK_TCK")
    except (OSError, ValueError, IndexError):
        return None
