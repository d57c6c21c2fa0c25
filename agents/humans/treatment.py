"""The playing of a recording in numbers: its sampling, its range, and the changes to it.

:class:`.Recorded` makes the same changes; a test compares the two. Its code belongs to the digests
of suites, which a report must not change.
"""

from dataclasses import asdict, dataclass

import numpy as np
from colift.agents.humans.as_recorded import UNCHANGED, AsRecorded
from colift.agents.humans.recorded import Recorded
from colift.agents.humans.shape import shape_of

DIGITS = 4
"""Significant digits of the numbers: more than a reader needs, fewer than rounding can change."""


@dataclass(frozen=True, kw_only=True)
class Treatment:
    """The sampling and the range of a recording, and the changes to it when it is played."""

    rate_hz: float
    """Samples per second, by the median of their intervals."""
    range_m: float
    """Highest minus lowest recorded height."""
    scale: float
    """Factor of the heights; above 1, the noise of the recording is enlarged, too."""
    slow_down: float
    """Factor of the duration, at least 1, beside the ramps at both ends."""
    inverted: bool
    """Whether down became up: the hand goes further below its first height than above it."""

    def plain(self) -> dict[str, float | bool]:
        """Return the numbers by name, with :data:`DIGITS` significant digits."""
        return {
            name: value if isinstance(value, bool) else float(f"{value:.{DIGITS}g}")
            for name, value in asdict(self).items()
        }


def treatment_of(human: Recorded) -> Treatment:
    """Return the sampling and the range of a person's recording, and the changes to it."""
    recording, changed = human.recording, not isinstance(human, AsRecorded)
    shape = shape_of(recording, invert=changed)
    return Treatment(
        rate_hz=1.0 / float(np.median(np.diff(recording.times))),
        range_m=max(recording.heights) - min(recording.heights),
        scale=shape.scale if changed else UNCHANGED,
        slow_down=shape.slow_down if changed else UNCHANGED,
        inverted=shape.inverted,
    )
