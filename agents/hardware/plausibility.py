"""Plausibility of motion capture: invisible, too old, jumped, or against the encoders."""

import math
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from typing import Final

from colift.agents.hardware.ports import Sample
from colift.agents.hardware.stops import HoldReason

STALE: Final = 0.2
"""Age of the newest frame [s] from which the hands are held."""

AHEAD: Final = 0.03
"""Largest lead of a frame's time stamp over this machine's clock [s]: the clocks are synchronised
to within half a round trip, which takes up to 50 ms over a wireless network."""

FEWEST: Final = 25
"""Fewest new frames in a second with which the hands are moved: half of the rate that the set-up
requires."""

FASTEST: Final = 2.0
"""Highest plausible speed of a table end [m/s]. Free hands peak at 1.84 +- 0.43 m/s in
vertical movements of 0.8 m; people who move together with a robot reach a fraction of that."""

SLACK: Final = 0.005
"""Change between two frames [m] that is noise, whatever the time between them."""

AGREEMENT: Final = 0.03
"""Largest plausible distance between the hands by their encoders and the robot's table end [m]:
beyond it the grip is lost, or the motion capture has drifted or mistakes one end for the other."""

SETTLED: Final = 0.1
"""Time [s] without a jump after which the motion capture is believed again."""


def stamped(sample: Sample, now: float) -> bool:
    """Return whether a frame's time stamp is possible: a number, and not ahead of the clock."""
    return -math.inf < sample.time <= now + AHEAD


def in_order(samples: Iterable[Sample], newest: float = -math.inf) -> Iterator[Sample]:
    """Yield the frames that are newer than all before them, the rule for all uses of frames.

    A frame that was repeated or overtaken says nothing new, and one whose clock has gone back says
    when it was captured no more.

    Parameters
    ----------
    samples
        Frames in the order in which they came.
    newest
        Time of the newest frame before them [s].
    """
    for sample in samples:
        if sample.time > newest:
            newest = sample.time
            yield sample


def disordered(samples: Sequence[Sample]) -> int:
    """Return the number of frames that :func:`in_order` leaves out."""
    stamps = [sample for sample in samples if not math.isnan(sample.time)]
    return len(stamps) - len(list(in_order(stamps)))


def seen(sample: Sample) -> bool:
    """Return whether both ends were seen in a frame."""
    return math.isfinite(sample.human_end) and math.isfinite(sample.robot_end)


def jumped(before: Sample, after: Sample) -> bool:
    """Return whether an end moved further between two frames than it can."""
    reach = SLACK + FASTEST * abs(after.time - before.time)
    moved = max(abs(after.human_end - before.human_end), abs(after.robot_end - before.robot_end))
    return moved > reach


def at(samples: Sequence[Sample], time: float) -> Sample:
    """Return the ends' heights at a time, interpolated linearly between two frames.

    Before the first frame and after the last, the heights are those of that frame: nothing is
    extrapolated.

    Parameters
    ----------
    samples
        At least one, in the order of their times.
    """
    later = samples[-1]
    if time >= later.time:
        return later
    for sample in reversed(samples[:-1]):
        if sample.time <= time:
            share = (time - sample.time) / (later.time - sample.time)
            return Sample(
                time,
                sample.human_end + share * (later.human_end - sample.human_end),
                sample.robot_end + share * (later.robot_end - sample.robot_end),
            )
        later = sample
    return later


class CaptureMonitor:
    """Supervision of the motion capture, with the last second of plausible frames."""

    def __init__(self) -> None:
        self._kept: list[Sample] = []
        self._newest: Sample | None = None
        self._jump: float | None = None
        self._begin: float | None = None
        self._misdated = False
        self._times: deque[float] = deque()
        self._hands: list[tuple[float, float]] = []

    @property
    def samples(self) -> Sequence[Sample]:
        """The plausible frames of the last second, oldest first."""
        return self._kept

    def take(self, frames: Sequence[Sample], misdated: int = 0) -> None:
        """Add new frames, without those out of order.

        Parameters
        ----------
        frames
            New frames with possible time stamps, as they came.
        misdated
            Number of other frames that came with them. If there are any, no stamp is trusted: a
            clock that is ahead makes an older frame look new.
        """
        self._misdated = misdated > 0
        last = self._newest
        for frame in in_order(frames, -math.inf if last is None else last.time):
            self._newest = frame
            self._begin = frame.time if self._begin is None else self._begin
            self._times.append(frame.time)
            if not seen(frame):
                continue
            if self._kept and jumped(self._kept[-1], frame):
                self._jump = frame.time
                self._kept.clear()
            self._kept.append(frame)
        while self._kept and self._kept[0].time < self._kept[-1].time - 1.0:
            self._kept.pop(0)

    def age(self, now: float) -> float:
        """Return the age of the newest frame [s], infinite before the first."""
        return math.inf if self._newest is None else now - self._newest.time

    def rate(self, now: float) -> float:
        """Return the number of new frames in the last second; infinite in the first second."""
        while self._times and self._times[0] <= now - 1.0:
            self._times.popleft()
        if self._begin is None or now - self._begin < 1.0:
            return math.inf
        return len(self._times)

    def judge(self, now: float, hand_height: float) -> HoldReason | None:
        """Return the reason not to act on the motion capture now, or None.

        Parameters
        ----------
        now
            The time [s].
        hand_height
            Height of the robot's hands by the encoders, now [m].
        """
        self._hands.append((now, hand_height))
        del self._hands[:-64]
        newest = self._newest
        if newest is None or self._misdated or now - newest.time > STALE:
            return HoldReason.STALE
        if self.rate(now) < FEWEST:
            return HoldReason.FEW
        if not seen(newest):
            return HoldReason.NOT_SEEN
        if self._jump is not None and newest.time - self._jump < SETTLED:
            return HoldReason.JUMP
        if self._disagrees(newest):
            return HoldReason.DISAGREE
        return None

    def _disagrees(self, newest: Sample) -> bool:
        """Return whether the robot's end is away from the recent and present hand heights."""
        recent = [height for time, height in self._hands if time >= newest.time - 0.15]
        low, high = min(recent), max(recent)
        return not low - AGREEMENT <= newest.robot_end <= high + AGREEMENT
