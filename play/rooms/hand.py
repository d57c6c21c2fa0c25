"""The hand of a real person during a lift: its samples are checked, kept and resampled."""

import math

import numpy as np
from colift.agents.humans import HandLog, Resampler
from colift.agents.humans.hand_log import FARTHEST, MOST_SAMPLES


class LiveHand:
    """A person's hand in one lift, from the arriving samples to the log that proves them.

    Parameters
    ----------
    offset
        Time of the lift minus the time of the sender's clock [s].
    delay
        Playout delay [s].
    """

    def __init__(self, offset: float, delay: float) -> None:
        self._offset, self._delay = offset, delay
        self._resampler = Resampler(offset, delay)
        self._times: list[float] = []
        self._heights: list[float] = []
        self._frames: list[int] = []
        self._numbers: list[int] = []
        self._next = 0
        self._sent = 0
        self.refused = 0
        """Number of samples that could not be used: not finite, out of range, out of order, too
        many."""

    @property
    def samples(self) -> int:
        """Number of samples that were used."""
        return len(self._times)

    @property
    def starved(self) -> int:
        """Frames for which no later sample had arrived."""
        return self._resampler.starved

    @property
    def starving(self) -> bool:
        """Whether a later sample was missing for the last frame."""
        return self._resampler.starving

    @property
    def used(self) -> int:
        """Number of samples sent up to the newest one on which the last reference depends."""
        count = self._resampler.used
        return self._numbers[count - 1] + 1 if count else 0

    def add(self, time: float, height: float) -> None:
        """Accept a sample: the sender's time [s] and the height above the grip [m]."""
        self._sent += 1
        last = self._times[-1] if self._times else -math.inf
        usable = math.isfinite(time) and abs(height) <= FARTHEST and time > last
        if not usable or len(self._times) >= MOST_SAMPLES:
            self.refused += 1
            return
        self._numbers.append(self._sent - 1)
        self._times.append(time)
        self._heights.append(height)
        self._frames.append(self._next)
        self._resampler.add(time, height)

    def next(self) -> float:
        """Return the reference at the end of the next frame [m]."""
        frame = self._next
        self._next = frame + 1
        return self._resampler.reference(frame)

    def log(self) -> HandLog:
        """Return the used samples, each with the frame before which it arrived."""
        return HandLog(
            offset=self._offset,
            delay=self._delay,
            times=np.array(self._times, dtype=np.float64),
            heights=np.array(self._heights, dtype=np.float64),
            frames=np.array(self._frames, dtype=np.int64),
        )
