"""The heights of the table's ends, from the positions of markers: hidden and frozen ones included.

The height of an end is the mean over its markers, as in the paper (section II.A). An end is not
seen if one of its markers is not: because it is hidden (NaN), or because it is frozen. Some clients
repeat the last position of a marker that is lost; a hand or a table that is held never rests so
still that a camera measures the same twice.
"""

import math
from collections.abc import Sequence
from typing import Final, NamedTuple

from .ports import Sample

FROZEN_FRAMES: Final = 10
"""Frames in a row with the same height of a marker, to the bit, from which it counts as frozen.

Heights have a noise of 0.2 to 0.3 mm. Two in a row are the same with a probability of 1e-4 where
they are sent as 32-bit floats, and ten in a row of a marker at rest with less than 1e-6 where they
are rounded to 0.1 mm. A false alarm holds the hands for a period."""

FROZEN_TIME: Final = 0.1
"""How long these frames must last [s]: a client may send each frame of its cameras several times.
At 100 Hz both limits mean the same; at the lowest rate, 50 Hz, ten frames take 0.2 s."""


class Height(NamedTuple):
    """Where in a row the height of a marker is."""

    marker: str
    channel: int
    scale: float
    """Metres per unit."""


class _Repeated:
    """How often, and for how long, a marker has been at the same height."""

    def __init__(self) -> None:
        self._value, self._since, self._count = math.nan, 0.0, 0

    def frozen(self, time: float, value: float) -> bool:
        """Take in the height at a time; return whether it has been the same for too long."""
        if value != self._value:
            self._value, self._since, self._count = value, time, 0
        self._count += 1
        return self._count >= FROZEN_FRAMES and time - self._since >= FROZEN_TIME


class MarkerEnds:
    """Turns rows of marker positions into samples of the table's ends.

    Parameters
    ----------
    human, robot
        The markers of each end.
    rest
        Height of both ends at rest [m].
    """

    def __init__(self, human: Sequence[Height], robot: Sequence[Height], rest: float = 0.0) -> None:
        self._human, self._robot = tuple(human), tuple(robot)
        self._human_rest = self._robot_rest = rest
        self._repeated = {height.marker: _Repeated() for height in (*human, *robot)}
        self._hidden: list[str] = []
        self._frozen: list[str] = []

    def set_rest(self, human_end: float, robot_end: float) -> None:
        """Take the present zero of the ends' heights [m] to be displaced by these."""
        self._human_rest += human_end
        self._robot_rest += robot_end

    def sample(self, time: float, row: Sequence[float]) -> Sample:
        """Return the ends' heights in the next row, which was captured at a time [s]."""
        self._hidden, self._frozen = [], []
        return Sample(
            time,
            self._height(time, row, self._human) - self._human_rest,
            self._height(time, row, self._robot) - self._robot_rest,
        )

    def _height(self, time: float, row: Sequence[float], markers: Sequence[Height]) -> float:
        """Return the mean height of some markers [m]; NaN if one is hidden or frozen."""
        total = 0.0
        for marker, channel, scale in markers:
            value = row[channel] * scale
            if not math.isfinite(value):
                self._hidden.append(marker)
            elif self._repeated[marker].frozen(time, value):
                self._frozen.append(marker)
            total += value
        unseen = any(height.marker in (*self._hidden, *self._frozen) for height in markers)
        return math.nan if unseen else total / len(markers)

    @property
    def unseen(self) -> str:
        """Which markers were not seen in the last row, and why; empty if all were."""
        told = []
        if self._hidden:
            told.append(f"{', '.join(self._hidden)} hidden")
        if self._frozen:
            told.append(
                f"{', '.join(self._frozen)} frozen: the same height to the bit in "
                f"{FROZEN_FRAMES} frames or more"
            )
        return "; ".join(told)
