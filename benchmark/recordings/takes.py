"""A take of a recording, and the lifts that were cut from it."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from colift.benchmark.recordings.choosing import Track
from colift.benchmark.recordings.motion import Motion, Series
from colift.benchmark.recordings.unseen import gaps_in


@dataclass(frozen=True, kw_only=True, eq=False)
class Taken:
    """A lift, ready to be written."""

    trial: str
    person: str
    times: Series
    """[s] from the first sample of the recording, shape (n,)."""
    heights: Series
    """[m]"""
    phases: tuple[str, ...]
    """The phase at each time; empty at rest."""
    far: Series | None
    """Height of the other end [m]."""

    @property
    def rise(self) -> float:
        """Height of the rise [m]; of a recording that was not cut, the range of its heights."""
        rising = self.heights[np.array(self.phases) == "rise"]
        return float(rising[-1] - rising[0]) if rising.size else float(np.ptp(self.heights))

    @property
    def duration(self) -> float:
        """Duration of the rise [s]; of a recording that was not cut, all of it."""
        rising = self.times[np.array(self.phases) == "rise"]
        return float(np.ptp(rising if rising.size else self.times))


@dataclass(frozen=True, kw_only=True, eq=False)
class Take:
    """A take, and the lifts in it."""

    file: Path
    track: Track
    lifts: tuple[Taken, ...]
    left_out: tuple[str, ...]
    """The reason for each lift, or the whole take, that was left out."""
    filled: int
    """Samples that were filled, in all lifts."""

    @property
    def motion(self) -> Motion:
        """The points from which the hand was chosen."""
        return self.track.motion

    @property
    def rate(self) -> float:
        """Samples per second."""
        return 1.0 / float(np.median(np.diff(self.motion.times)))

    @property
    def gaps(self) -> tuple[float, ...]:
        """Duration of each gap between the first and the last seen sample [s]."""
        times, heights = self.motion.times, self.track.heights
        inner = (g for g in gaps_in(heights) if g.start > 0 and g.stop < len(heights))
        return tuple(gap.seconds(times) for gap in inner)
