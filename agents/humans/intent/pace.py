"""The pace at which a person goes through a plan: slower while the far end is off its path."""

from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans import Subject
from colift.agents.humans.intent.manner import leading_manner
from numpy.typing import NDArray

CATCHING_UP: Final = 1.25
"""Fastest pace, for a person who is late; 1 is the plan's own."""


class Pace:
    """The time within a plan for each frame of an episode.

    A person who sees the far end at a distance e from its planned height goes through the plan at

        min(max(2 - e / patience, 0), 1)

    of its speed, and waits from twice the patience on. Afterwards the person catches up, at most at
    :data:`CATCHING_UP`. What is seen is one visual delay old.

    Parameters
    ----------
    subject
        The person.
    far
        (n,) planned height of the far end at the end of each frame [m].
    """

    def __init__(self, subject: Subject, far: NDArray[np.float64]) -> None:
        self._patience = leading_manner(subject).patience
        self._delay = round(subject.visual_delay / FRAME)
        self._far = far
        self._times: list[float] = []

    def coming(self, frames: int, far_end: list[float]) -> list[float]:
        """Return the time within the plan at the end of each of the next frames, in frames.

        Parameters
        ----------
        frames
            Number of these frames.
        far_end
            Height of the far end [m], newest last.
        """
        past = len(self._times)
        now = self._times[-1] if past else 0.0
        seen = self._times[past - 1 - self._delay] if past > self._delay else 0.0
        away = abs(far_end[-1 - self._delay] - self.far_at(seen))
        pace = min(max(2.0 - away / self._patience, 0.0), 1.0)
        late = past - now
        if late > 0.0:
            pace = min(pace * CATCHING_UP, pace + late / frames)
        times = [now + pace * (i + 1) for i in range(frames)]
        self._times += times
        return times

    def far_at(self, time: float) -> float:
        """Return the planned height of the far end [m] at a time within the plan, in frames."""
        return planned_at(self._far, time)


def planned_at(series: NDArray[np.float64], time: float) -> float:
    """Return the interpolated value, at a time in frames, of a series of values at frame ends.

    Before its first frame it is 0, after its last frame the last value.
    """
    place = time - 1.0
    last = len(series) - 1
    if place >= last:
        return float(series[last])
    index = int(place // 1)
    before = float(series[index]) if index >= 0 else 0.0
    after = float(series[index + 1]) if index >= -1 else 0.0
    return before + (place - index) * (after - before)
