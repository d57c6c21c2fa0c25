"""Frames received from the motion capture, without those of impossible time stamps."""

import math
from typing import Final, NamedTuple

from colift.agents.hardware.plausibility import stamped
from colift.agents.hardware.ports import MotionCapture, Sample
from colift.agents.hardware.stops import losses_stop

UNDATED: Final = Sample(math.nan, math.nan, math.nan)
"""Entry of a log for a frame with an impossible time stamp."""


class Drained(NamedTuple):
    """Frames received since the last call."""

    frames: list[Sample]
    """Frames with possible time stamps, oldest first."""
    misdated: int
    """Number of other frames: stamp ahead of the clock, or not a number. They count as lost."""


def drained(capture: MotionCapture, now: float) -> Drained:
    """Return the newest frames; ``now`` is the time before the request [s].

    Raises
    ------
    StopTrialError
        If no more will come.
    """
    with losses_stop():
        frames = capture.drain()
    dated = [frame for frame in frames if stamped(frame, now)]
    return Drained(dated, len(frames) - len(dated))
