"""A person's hand during a live lift: samples of a pointer, and the reference of each frame."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Protocol, Self

import numpy as np
from colift.agents.agent import FRAME
from colift.base.errors import InputError
from numpy.typing import NDArray

LONGEST_DELAY: Final = 0.25
"""Longest playout delay of samples [s]."""

MOST_SAMPLES: Final = 120_000
"""Most samples of a lift: 120 s at 1 kHz, the rate of the fastest common mice."""

FARTHEST: Final = 2.0
"""Largest height of a sample [m]; the reference itself is clipped much earlier."""


class Hand(Protocol):
    """A hand that gives its reference for one frame after the other."""

    def next(self) -> float:
        """Return the reference at the end of the next frame [m]."""


class Resampler:
    """Turns time-stamped samples of a hand into its reference in each frame.

    The reference of frame n, which ends at ``t = (n + 1) FRAME``, is the height of the hand at
    ``t - delay``: interpolated linearly between the two samples around that time, if they arrived
    before the frame. Before the first sample it is 0, the height of the grip. If no later sample
    has arrived, the hand stays where it was last seen, and the frame counts as starved.

    The delay lets samples arrive in time. Holding each sample until the next one comes would
    instead turn 60 samples per second into a staircase.

    Parameters
    ----------
    offset
        Time of the lift minus the time of the sender's clock [s].
    delay
        Playout delay [s].
    """

    def __init__(self, offset: float, delay: float) -> None:
        self._offset = offset
        self._delay = delay
        self._before = (-math.inf, 0.0)
        self._later: list[tuple[float, float]] = []
        self._next = 0
        self._asked = False
        self.starved = 0
        """Frames for which no later sample had arrived."""
        self.starving = False
        """Whether the last frame was one of them."""

    def add(self, time: float, height: float) -> None:
        """Accept a sample: the sender's time [s], later than that of the last, and height [m]."""
        self._later.append((time + self._offset, height))

    @property
    def used(self) -> int:
        """Number of samples up to the newest one on which the last reference depends."""
        return min(self._next + 1, len(self._later)) if self._asked else 0

    def reference(self, frame: int) -> float:
        """Return the reference at the end of a frame [m]; frames are asked for in order."""
        time = (frame + 1) * FRAME - self._delay
        later, self._asked = self._later, True
        while self._next < len(later) and later[self._next][0] <= time:
            self._before = later[self._next]
            self._next += 1
        begin, low = self._before
        self.starving = self._next == len(later)
        if self.starving:
            self.starved += 1
            return low
        end, high = later[self._next]
        if begin == -math.inf:
            return low
        return low + (high - low) * (time - begin) / (end - begin)


@dataclass(frozen=True, kw_only=True, eq=False)
class HandLog:
    """All samples of one hand in one lift, as they were used: the evidence of a live lift.

    Raises
    ------
    InputError
        If it cannot be the log of a lift.
    """

    offset: float
    """Time of the lift minus the time of the sender's clock [s]."""
    delay: float
    """Playout delay [s]."""
    times: NDArray[np.float64]
    """(n,) the sender's time of each sample [s], increasing."""
    heights: NDArray[np.float64]
    """(n,) height of the hand above the grip [m]."""
    frames: NDArray[np.int64]
    """(n,) the first frame that could use the sample: it had arrived before it."""

    def __post_init__(self) -> None:
        """Check the shapes and the ranges."""
        sizes = {len(self.times), len(self.heights), len(self.frames)}
        if len(sizes) != 1 or max(sizes) > MOST_SAMPLES:
            raise InputError(
                f"a hand's log must have equally many times, heights and frames, at most "
                f"{MOST_SAMPLES}; got {len(self.times)}, {len(self.heights)}, {len(self.frames)}"
            )
        if not (math.isfinite(self.offset) and 0 <= self.delay <= LONGEST_DELAY):
            raise InputError(
                f"a hand's log must have a finite offset and a delay of 0 to {LONGEST_DELAY} s, "
                f"got {self.offset} and {self.delay}"
            )
        if not (np.isfinite(self.times).all() and (np.diff(self.times) > 0).all()):
            raise InputError("times of a hand's log must be finite and increase")
        if not (np.abs(self.heights) <= FARTHEST).all():
            raise InputError(f"heights of a hand's log must be within {FARTHEST} m")
        if (np.diff(self.frames, prepend=0) < 0).any():
            raise InputError("frames of a hand's log must not be negative or decrease")

    @classmethod
    def of_references(cls, references: Sequence[float]) -> Self:
        """Return a log that gives these references [m], one per frame, bit for bit.

        A published live lift contains this log: the movement, without the pointer's samples, which
        are personal data.
        """
        frames = np.arange(len(references))
        return cls(
            offset=0.0,
            delay=0.0,
            times=np.asarray((frames + 1) * FRAME, dtype=np.float64),
            heights=np.array(references, dtype=np.float64),
            frames=frames,
        )

    def resampler(self) -> Resampler:
        """Return a resampler that has no samples yet."""
        return Resampler(self.offset, self.delay)


class LoggedHand:
    """Plays the references of a log again, frame by frame; see :class:`Resampler`."""

    def __init__(self, log: HandLog) -> None:
        self._log = log
        self.begin()

    def begin(self) -> None:
        """Go back to the first frame."""
        self._resampler = self._log.resampler()
        self._samples = list(
            zip(
                self._log.times.tolist(),
                self._log.heights.tolist(),
                self._log.frames.tolist(),
                strict=True,
            )
        )
        self._added = 0
        self._frame = 0

    def next(self) -> float:
        """Return the reference at the end of the next frame [m]."""
        samples, frame = self._samples, self._frame
        while self._added < len(samples) and samples[self._added][2] <= frame:
            time, height, _ = samples[self._added]
            self._resampler.add(time, height)
            self._added += 1
        self._frame = frame + 1
        return self._resampler.reference(frame)
