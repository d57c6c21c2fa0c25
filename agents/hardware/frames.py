"""Taking in what the motion capture has sent: frames with a time stamp that can be."""

import math
from typing import Final, NamedTuple

from .plausibility import stamped
from .ports import MotionCapture, Sample
from .stops import losses_stop

UNDATED: Final = Sample(math.nan, math.nan, math.nan)
"""What a log has for a frame whose time stamp cannot be: nothing is known of it."""


class Drained(NamedTuple):
    """What has come in since the last time."""

    frames: list[Sample]
    """Those whose time stamps can be, oldest first."""
    misdated: int
    """How many others there were: a stamp ahead of the clock, or none. They are as good as lost."""


def drained(capture: MotionCapture, now: float) -> Drained:
    """Return the newest frames; ``now`` is the time before they were asked for [s].

    Raises
    ------
    StopTrialError
        If no more will come.
    """
    with losses_stop():
        frames = capture.drain()
    dated = [frame for frame in frames if stamped(frame, now)]
    return Drained(dated, len(frames) - len(dated))
